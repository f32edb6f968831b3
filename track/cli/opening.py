"""Opens what a person named on the command line: cameras and model."""

import contextlib
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from facegen.redaction import without_secrets
from track.errors import InputError

if TYPE_CHECKING:
    from track.session.pipeline import Pipeline
    from track.sources import Capture

_NAMED = re.compile(r"([A-Za-z0-9][A-Za-z0-9_.-]{0,63})=(.+)", re.DOTALL)

ONE = "camera"
"""What the camera of a landmark model is called."""


@dataclass(frozen=True, kw_only=True)
class Wishes:
    """What was asked for, of cameras and model.

    Parameters
    ----------
    cameras
        As they were written.
    model, detector, detector_file, profile, filter_name, neutral, placement, headset
        Options' values.
    fast, loop, fps
        Pace of kept pictures, and whether they come again and again.
    calibrating
        Whether a neutral face is about to be asked for, so that nobody is told to calibrate.
    """

    cameras: Sequence[str] = ()
    model: str | None = None
    detector: str | None = None
    detector_file: Path | None = None
    profile: str | None = None
    filter_name: str = "groups"
    neutral: str | None = None
    placement: Path | None = None
    headset: str | None = None
    fast: bool = False
    loop: bool = False
    fps: float = 30.0
    calibrating: bool = False


def camera_texts(cameras: Sequence[str], *, headset: bool) -> dict[str, str]:
    """What opens each camera, by its name.

    Raises
    ------
    InputError
        Where a headset's camera has no name, a name comes twice, or a landmark model has several cameras.
    """
    if not headset:
        if len(cameras) > 1:
            raise InputError(
                f"{len(cameras)} cameras are given, and a model of landmarks takes one; --model names a headset's"
            )
        return {ONE: (cameras or ["0"])[0]}
    texts = {}
    for written in cameras:
        match = _NAMED.fullmatch(written)
        if match is None:
            shown = without_secrets(written)
            raise InputError(
                f"--camera {shown}: a headset's camera needs its name before it, as in left_eye={shown}"
            )
        if match[1] in texts:
            raise InputError(f"--camera {match[1]} is given twice")
        texts[match[1]] = match[2]
    return texts


def is_headset(wishes: Wishes) -> bool:
    """Whether the model is a headset's; cameras with names say so where no model is named."""
    from regress.runtime.headset.network.predictor import is_headset_model

    if wishes.model is not None:
        return is_headset_model(wishes.model)
    return are_named(wishes.cameras)


def are_named(cameras: Sequence[str]) -> bool:
    """Whether each camera has its name before it."""
    return bool(cameras) and all(_NAMED.fullmatch(each) for each in cameras)


def open_pipeline(wishes: Wishes, texts: dict[str, str], say: Callable[[str], None]) -> "Pipeline":
    """The stages for these cameras.

    Raises
    ------
    InputError
        Where model, detector or cameras cannot be used together.
    """
    from regress.runtime.ready_made import HEADSET, LANDMARKS

    if is_headset(wishes):
        from track.session.headset import HeadsetPipeline

        if wishes.detector is not None:
            raise InputError(
                f"--detector {wishes.detector} finds 68 points, and a headset's model takes pictures"
            )
        if wishes.neutral not in (None, "none"):
            raise InputError(
                f"--neutral {wishes.neutral} is of points; a headset's neutral face comes from `track calibrate`"
            )
        pipeline = HeadsetPipeline(wishes.model or HEADSET, filter_name=wishes.filter_name, opened=texts)
        strangers = [name for name in texts if name not in pipeline.cameras]
        if strangers or not texts:
            found = f"there is no camera {strangers[0]!r}" if strangers else "no camera is given"
            raise InputError(
                f"{found}; the model's are {', '.join(pipeline.cameras)}: --camera {pipeline.cameras[0]}=0"
            )
        return pipeline
    from track.detectors import open_detector
    from track.session.landmarks import LandmarkPipeline

    (text,) = texts.values()
    name = wishes.detector or ("points" if text == "-" else "mediapipe")
    with contextlib.ExitStack() as refused:
        detector = open_detector(name, wishes.detector_file)
        refused.callback(detector.close)  # left open, MediaPipe's prints a traceback as Python ends
        pipeline = LandmarkPipeline(
            wishes.model or LANDMARKS,
            detector=detector,
            detector_name=name,
            filter_name=wishes.filter_name,
            auto=wishes.neutral == "auto",
            say=say,
        )
        refused.pop_all()
        return pipeline


def open_cameras(wishes: Wishes, texts: dict[str, str], say: Callable[[str], None]) -> "Capture":
    """Begin to read the cameras; what they do otherwise than asked is said.

    Raises
    ------
    CameraError
        Where one cannot be opened.
    """
    from track.sources import Pace, open_capture

    return open_capture(texts, Pace(fast=wishes.fast, fps=wishes.fps, again=wishes.loop), say=say)
