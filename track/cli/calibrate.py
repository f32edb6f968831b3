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
    fps: FpsOption = 30.0,
) -> None:
    """Record your neutral face and your own full movements: say what to do, count down, judge, keep.

    Example: track calibrate --camera 0 --profile anna
    """
    from facegen.console import say
    from track.cli.opening import Wishes, camera_texts, is_headset
    from track.cli.running import RunOptions, ended_by_signals, open_session
    from track.errors import InputError
    from track.messages import Command, Moment
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
        fps=fps,
    )
    faces_of(faces)
    texts = camera_texts(wishes.cameras, headset=is_headset(wishes))

    class Prompt:
        """Says each step once, and ends the session behind the last one."""

        said = ""

        def publish(self, moment: Moment) -> None:
            step = moment.step
            line = f"{step.name.replace('_', ' ')}: {step.state}" + (f": {step.text}" if step.text else "")
            if line != self.said:
                self.said = line
                say(line)
            if not session.adjusting.calibrating:
                session.stop()

    with contextlib.ExitStack() as closing:
        session, capture = open_session(wishes, texts, [], say, closing, options=RunOptions())
        session.ask(Command(verb="calibrate", value=faces))
        with ended_by_signals(session, capture):
            session.run(capture, Prompt())
        if session.adjusting.calibrating:
            raise InputError("the pictures ended before calibration did; everything found before it is kept")
        step = session.adjusting.step
        if step is not None and step.state == "cancelled":
            raise InputError(step.text)
