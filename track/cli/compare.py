"""``track compare``: this camera's tracking beside a phone's."""

import contextlib
import dataclasses
import json
import re
import shlex
import time
from pathlib import Path
from typing import Annotated

import typer

from track.cli.options import (
    CameraOption,
    DetectorFileOption,
    DetectorOption,
    FilterOption,
    FpsOption,
    ModelOption,
    NeutralOption,
    ProfileOption,
)


def compare(
    truth: Annotated[
        str,
        typer.Option(
            "--truth", metavar="livelink[:PORT]", help="The phone's stream, of the Live Link Face app."
        ),
    ] = "livelink",
    camera: CameraOption = None,
    model: ModelOption = None,
    detector: DetectorOption = None,
    detector_file: DetectorFileOption = None,
    profile: ProfileOption = None,
    neutral: NeutralOption = None,
    filter_name: FilterOption = "groups",
    fps: FpsOption = 30.0,
    seconds: Annotated[
        float, typer.Option("--seconds", min=8.0, max=86400.0, help="How long to record.")
    ] = 60.0,
    keep: Annotated[
        Path | None,
        typer.Option(
            "--keep",
            help="Folder to make of the take: points and the phone's weights, for `regress evaluate`.",
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Unrounded figures for programs.")] = False,
) -> None:
    """Act before camera and phone at once; get r and the mean absolute error of every shape.

    Example: track compare --truth livelink:11111 --seconds 60
    """
    import numpy as np

    from facegen.console import counted, say
    from track.cli.opening import Wishes, camera_texts, is_headset
    from track.cli.running import RunOptions, ended_by_signals, open_session
    from track.comparison.comparison import compare_weights
    from track.comparison.phone import PORT, Phone
    from track.comparison.take import check_place, write_take
    from track.errors import InputError
    from track.sinks.sink import Sink

    wishes = Wishes(
        cameras=camera or (),
        model=model,
        detector=detector,
        detector_file=detector_file,
        profile=profile,
        filter_name=filter_name,
        neutral=neutral,
        fps=fps,
    )
    match = re.fullmatch(r"livelink(?::(\d{1,5}))?", truth)
    if match is None or not 0 <= int(match[1] or PORT) <= 65535:
        raise InputError(f"--truth {truth}: livelink or livelink:PORT is known")
    if keep is not None and (keep.exists() or is_headset(wishes)):
        raise InputError(
            f"--keep {keep}: "
            + ("is there already" if keep.exists() else "a take is of points, not of a headset")
        )
    if keep is not None:
        check_place(keep)  # before a person acts for a minute

    class Tracked(Sink):
        """Keeps what a filter and the person's profile have made of each frame, by this machine's clock."""

        title = "comparison"

        def __init__(self) -> None:
            self.times_s, self.weights, self.points = [], [], []

        def send(self, sample) -> None:
            points = np.zeros((68, 2)) if is_headset(wishes) else sample.points
            if points is not None and np.isfinite(points).all() and np.isfinite(sample.weights).all():
                # how old the frame is, by the clock that its time is of
                self.times_s.append(time.perf_counter() - (capture.now_s() - sample.time_s))
                self.weights.append(sample.weights)
                self.points.append(points)

    tracked = Tracked()
    texts = camera_texts(wishes.cameras, headset=is_headset(wishes))
    with contextlib.ExitStack() as closing:
        phone = Phone(int(match[1] or PORT))
        closing.callback(phone.close)
        # the phone's left is the person's, whatever their avatar shows
        options = RunOptions(mirror=False)
        session, capture = open_session(
            wishes, texts, [tracked], say, closing, options=options, must_keep=False
        )
        say(
            f"port {phone.port} waits for the phone; act for {seconds:g} s: talk, smile, blink, raise your brows"
        )
        with ended_by_signals(session, capture):
            session.run(capture, seconds=seconds)
        neutral_points = None if session.profile.neutral is None else session.profile.neutral.frames("points")
    times_s, truth_weights = phone.frames()
    found = compare_weights(np.array(tracked.times_s), np.array(tracked.weights), times_s, truth_weights)
    if keep is not None:
        write_take(
            keep,
            points=np.array(tracked.points)[found.rows],
            weights=found.truth,
            neutral=np.zeros((0, 68, 2)) if neutral_points is None else neutral_points,
        )
        say(f"kept {keep}; {judging(keep, calibrated=neutral_points is not None)} judges any model on it")
    if as_json:
        shapes = {name: dataclasses.asdict(figures) for name, figures in found.shapes.items()}
        summary = {
            "delay_ms": 1000 * found.alignment.delay_s,
            "frames": len(found.rows),
            "median_r": found.median_r,
        }
        typer.echo(json.dumps({**summary, "shapes": shapes}, allow_nan=False))
        return
    typer.echo(f"{'shape':<20} {'r':>6} {'MAE':>6} {'moved':>6}")
    for name, figures in found.shapes.items():
        if figures.r is not None:
            typer.echo(f"{name:<20} {figures.r:6.2f} {figures.mae:6.3f} {figures.moved:6.3f}")
    when = delay_in_words(found.alignment.delay_s)
    typer.echo(f"{counted(len(found.rows), 'frame')}; the phone is {when}; median r {found.median_r:.2f}")


def delay_in_words(delay_s: float) -> str:
    """By how much something is later, or earlier."""
    return f"{abs(1000 * delay_s):.0f} ms {'earlier' if delay_s < 0 else 'later'}"


def judging(take: Path, *, calibrated: bool) -> str:
    """The command that judges a model on a take, which has a neutral face or not."""
    return f"regress evaluate MODEL {shlex.quote(str(take))}" + (" --calibrated" if calibrated else "")
