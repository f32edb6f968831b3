"""``track calibrate``: a person's neutral face and ranges, into a profile."""

import contextlib
from typing import Annotated

import typer

from track.cli.options import (
    CameraOption,
    DetectorFileOption,
    DetectorOption,
    FastOption,
    FilterOption,
    FpsOption,
    HeadsetOption,
    LoopOption,
    ModelOption,
    PlacementOption,
    ProfileOption,
)


def calibrate(
    faces: Annotated[
        str,
        typer.Argument(
            help="all, or one: neutral, jaw_open, smile, brows_up, pucker, cheeks, eyes_shut; of headsets "
            "eyes_wide, lips_rolled, look_around too."
        ),
    ] = "all",
    camera: CameraOption = None,
    model: ModelOption = None,
    detector: DetectorOption = None,
    detector_file: DetectorFileOption = None,
    profile: ProfileOption = None,
    filter_name: FilterOption = "groups",
    placement: PlacementOption = None,
    headset: HeadsetOption = None,
    fast: FastOption = False,
    loop: LoopOption = False,
    fps: FpsOption = 30.0,
) -> None:
    """Record your neutral face and your own full movements: say what to do, count down, judge, keep.

    Example: track calibrate --camera 0 --profile anna
    """
    from facegen.console import say
    from facegen.errors import Drained
    from track.cli.opening import Wishes, camera_texts, is_headset
    from track.cli.running import RunOptions, ended_by_signals, open_session
    from track.errors import InputError
    from track.messages import Command, Moment
    from track.profile.places import known_path
    from track.session.faces import faces_of

    wishes = Wishes(
        cameras=camera or (),
        model=model,
        detector=detector,
        detector_file=detector_file,
        profile=profile,
        filter_name=filter_name,
        placement=placement,
        headset=headset,
        fast=fast,
        loop=loop,
        fps=fps,
        calibrating="neutral" in faces_of(faces),
    )
    texts = camera_texts(wishes.cameras, headset=is_headset(wishes))

    class Prompt:
        """Says each step once, and ends the session behind the last one."""

        said = ""

        def __init__(self) -> None:
            self.good: list[str] = []

        def publish(self, moment: Moment) -> None:
            if not session.adjusting.calibrating:  # how it ended the session has said
                session.stop()
                return
            step = moment.step
            name = step.name.replace("_", " ")
            line = f"{name}: {step.state}" + (f": {step.text}" if step.text else "")
            if line != self.said:
                self.said = line
                say(line)
                self.good += [name] if step.state == "done" else []

    prompt = Prompt()
    with contextlib.ExitStack() as closing:
        session, capture = open_session(wishes, texts, [], say, closing, options=RunOptions(own_blinks=False))
        session.ask(Command(verb="calibrate", value=faces))
        with ended_by_signals(session, capture):
            session.run(capture, prompt)
        if session.adjusting.calibrating:
            found = (
                f"{', '.join(prompt.good)} found before it stays"
                if prompt.good
                else "nothing was found before it"
            )
            if not capture.over:
                raise Drained(f"calibration was stopped; {found}")
            raise InputError(f"the pictures ended before calibration did; {found}")
        step = session.adjusting.step
        if step is not None and step.state in ("failed", "cancelled"):
            raise InputError(step.text)
        if not session.adjusting.has_kept:
            raise InputError("nothing was kept, as the neutral face is another one; calibrate neutral first")
        say(f"kept in {known_path(profile, capture.keys)}")
