"""Opens what a person named on the command line: cameras, model, profile, sinks."""

import contextlib
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from track.errors import InputError
from track.profile.neutral import NeutralFace
from track.profile.places import person_of, profile_path
from track.profile.profile import Profile, read_profile

if TYPE_CHECKING:
    from track.session.pipeline import Pipeline
    from track.sources import Capture

_NAMED = re.compile(r"([A-Za-z0-9][A-Za-z0-9_.-]{0,63})=(.+)", re.DOTALL)

_NOTHING_READ = {"ranges": {}, "rests": {}, "blinks": {}}
"""Of a profile whose neutral face or model is not the one that its ranges and blinks were read with."""

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
            raise InputError(
                f"--camera {written}: a headset's camera needs its name before it, as in left_eye={written}"
            )
        if match[1] in texts:
            raise InputError(f"--camera {match[1]} is given twice")
        texts[match[1]] = match[2]
    return texts


def is_headset(wishes: Wishes) -> bool:
    """Whether the model is a headset's; cameras with names say so where no model is named."""
    from regress.runtime.headset.predictor import is_headset_model

    if wishes.model is not None:
        return is_headset_model(wishes.model)
    return bool(wishes.cameras) and all(_NAMED.fullmatch(each) for each in wishes.cameras)


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
        pipeline = HeadsetPipeline(wishes.model or HEADSET, fps=wishes.fps, filter_name=wishes.filter_name)
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


def open_cameras(wishes: Wishes, texts: dict[str, str]) -> "Capture":
    """Begin to read the cameras.

    Raises
    ------
    CameraError
        Where one cannot be opened.
    """
    from track.sources import Pace, open_capture

    return open_capture(texts, Pace(fast=wishes.fast, fps=wishes.fps, again=wishes.loop))


def open_profile(
    wishes: Wishes, pipeline: "Pipeline", titles: dict[str, str], say: Callable[[str], None]
) -> tuple[Profile, Profile, Path]:
    """The person's profile as these options and this model use it, as its file has it, and where that lies.

    Where there is no file both are new.

    Raises
    ------
    InputError
        Where it is of another kind of model, or cannot be read.
    """
    camera = " ".join(titles.values())
    path = profile_path(wishes.profile, camera)
    profile = Profile(person=person_of(path)[:64], camera=camera[:200])
    stored = profile
    if path.is_file():
        stored = read_profile(path)
        profile = fitted(stored, pipeline, path, say)
    elif wishes.profile is not None and wishes.profile.endswith(".toml"):
        say(f"{path} does not exist yet; calibrating makes it")
    if wishes.placement is not None:
        profile = profile.model_copy(update={"placement": pipeline.read_placement(wishes.placement)})
    profile = _told(wishes.headset, profile, pipeline, say)
    if wishes.neutral in ("auto", "none"):
        profile = profile.model_copy(update={"neutral": None, **_NOTHING_READ})
    elif wishes.neutral is not None:
        profile = profile.model_copy(
            update={"neutral": _neutral_file(wishes.neutral, pipeline), **_NOTHING_READ}
        )
    elif profile.neutral is None and not wishes.calibrating:
        say(
            f"no neutral face is known yet for profile {profile.person} and this camera, so movements are guessed: "
            "calibrate on the page, or by `track calibrate`"
        )
    return profile, stored, path


def fitted(profile: Profile, pipeline: "Pipeline", path: Path, say: Callable[[str], None]) -> Profile:
    """A profile as this model can use it: another one's readings are left out.

    Raises
    ------
    InputError
        Where it is of another kind of model.
    """
    mark = profile.model
    if mark is None or mark == pipeline.mark:
        return profile
    if mark.kind != pipeline.mark.kind:
        raise InputError(
            f"{path} is a profile for a {mark.kind} model, and this one is a {pipeline.mark.kind} model; "
            f"--profile names another"
        )
    if profile.ranges or profile.rests:
        say(f"{path}: its ranges were read by another model and are left out; calibrate again")
    return profile.model_copy(update={**_NOTHING_READ, "model": None})


def _told(headset: str | None, profile: Profile, pipeline: "Pipeline", say: Callable[[str], None]) -> Profile:
    """The profile with the headset's cameras, where one is named; it is said where what is known stays untold."""
    from facegen.headsets import told_cameras

    if headset is None:
        if profile.told_cameras and not pipeline.listens:
            say("the profile knows where your cameras are, and this model is not told: headset-any is")
        return profile
    if headset == "none":
        return profile.model_copy(update={"told_cameras": {}})
    if pipeline.mark.kind != "headset":
        raise InputError(f"--headset {headset} is for a headset's cameras, and the model takes points")
    if not pipeline.listens:
        raise InputError(
            f"--headset {headset}: this model was trained for one place of the cameras and is not told where they are; "
            f"leave it out, or take --model headset-any"
        )
    terms = told_cameras(headset, pipeline.cameras)
    unknown = [name for name in pipeline.cameras if name not in terms]
    if unknown:
        say(f"--headset {headset} does not have {', '.join(unknown)}: of that the model is told nothing")
    told = {name: tuple(np.round(values, 6).tolist()) for name, values in terms.items()}
    return profile.model_copy(update={"told_cameras": told})


def _neutral_file(name: str, pipeline: "Pipeline") -> NeutralFace:
    from regress.runtime.inputs import read_frames

    if not Path(name).exists():
        raise InputError(f"--neutral {name!r} is no file; auto and none are allowed too")
    samples = [each for each in read_frames(name).samples() if pipeline.signature(each) is not None]
    if not samples:
        raise InputError(f"--neutral {name}: no frame has a face")
    return pipeline.neutral_of(samples)
