"""``track record``: pictures of cameras, side by side, for `regress headset check` and others."""

from pathlib import Path
from typing import Annotated

import typer

from track.cli.options import CameraOption, FastOption, FpsOption


def record(
    folder: Annotated[Path, typer.Argument(help="To make; it gets a folder of pictures for each camera.")],
    camera: CameraOption = None,
    seconds: Annotated[
        float, typer.Option("--seconds", min=0.1, max=86400.0, help="How long; Ctrl-C ends it sooner.")
    ] = 60.0,
    fast: FastOption = False,
    fps: FpsOption = 30.0,
) -> None:
    """Keep what cameras show: PNG as they give it, one number a moment in all folders, and times.csv.

    For a headset look around and blink meanwhile; `regress headset check` says whether a network can use it.

    Example: track record take --camera left_eye=0 --camera right_eye=1 --camera mouth=2
    """
    import math
    import shlex

    from facegen.console import counted, progress, say
    from facegen.files import check_new_folder
    from regress.runtime.headset.pictures.halves import split_half
    from track.cli.opening import Wishes, are_named, camera_texts, open_cameras
    from track.cli.running import ended_by_signals
    from track.errors import CameraError, InputError
    from track.footage import FootageWriter
    from track.session.fault_telling import FaultTelling
    from track.session.pipeline import sentences_of

    wishes = Wishes(cameras=camera or (), fast=fast, fps=fps)
    # of several each needs a name, which its folder gets
    texts = camera_texts(wishes.cameras, headset=len(wishes.cameras) > 1 or are_named(wishes.cameras))
    if any(split_half(text)[0] == "-" for text in texts.values()):
        raise InputError("--camera -: lines of points have no pictures to record")
    check_new_folder(folder, what="the take")
    telling, first_s = FaultTelling(say), None
    with open_cameras(wishes, texts, say) as capture, FootageWriter(folder, list(texts)) as writer:
        with ended_by_signals(capture), progress(unit="s") as told:
            for sample in capture:
                telling.step(sample.time_s, sentences_of(sample.faults))
                first_s = sample.time_s if first_s is None else first_s
                if sample.time_s - first_s > seconds - 1e-6:
                    break
                writer.write(sample)
                told("recorded", math.floor(sample.time_s - first_s), math.ceil(seconds))
    if not any(writer.written.values()):
        raise CameraError(f"no camera gave a picture, so there is no {folder}")
    for name, count in writer.written.items():
        say(f"{folder / name}: {counted(count, 'picture')}")
    if are_named(wishes.cameras):
        options = " ".join(f"--camera {shlex.quote(f'{name}={folder / name}')}" for name in texts)
        say(f"whether a network can use them says: regress headset check {options}")
