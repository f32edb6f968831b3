"""Opens a person's profile as a command's options and model use it, beside what its file has."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from track.cli.opening import Wishes
from track.errors import InputError
from track.profile.neutral import NeutralFace
from track.profile.places import camera_key, known_path, person_of, read_stored
from track.profile.profile import Profile

if TYPE_CHECKING:
    from regress.runtime.headset.pictures.placement import CameraPlacement
    from track.session.pipeline import Pipeline

_NOTHING_READ = {"ranges": {}, "rests": {}, "blinks": {}}
"""Of a profile whose neutral face or model is not the one that its ranges and blinks were read with."""


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
    camera = camera_key(titles)
    path = known_path(wishes.profile, titles)
    profile = Profile(person=person_of(path)[:64], camera=camera[:200])
    stored = profile
    if path.is_file():
        stored = read_stored(path)
        profile = fitted(stored, pipeline, path, say)
    elif wishes.profile is not None and wishes.profile.endswith(".toml"):
        say(f"{path} does not exist yet; calibrating makes it")
    if wishes.placement is not None:
        profile = _placed(wishes.placement, profile, pipeline, say)
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
    elif profile.neutral is not None and wishes.calibrating:
        profile = _use_or_leave_out_neutral(profile, pipeline, say)
    return profile, stored, path


def fitted(profile: Profile, pipeline: "Pipeline", path: Path, say: Callable[[str], None]) -> Profile:
    """A profile as this model can use it: what another one read, and where it saw the eyes, is left out.

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
    left = {**_NOTHING_READ, "eyes": {}, "model": None}
    of_it = [("ranges", profile.ranges or profile.rests), ("lids", profile.eyes)]
    if read := [name for name, known in of_it if known]:
        say(f"{path}: its {' and '.join(read)} were read by another model and are left out; calibrate again")
    if profile.placement and not pipeline.accepts_placement_of(mark):
        say(
            f"{path}: its placement was found with another network and is left out, and so is the neutral face "
            f"that was seen through it; `regress headset check` with this model finds a --placement for it"
        )
        left |= {"placement": {}, "neutral": None}
    return profile.model_copy(update=left)


def _placed(path: Path, profile: Profile, pipeline: "Pipeline", say: Callable[[str], None]) -> Profile:
    """The profile with a file's placement; without the neutral face where another part of pictures was seen in it."""
    placement = pipeline.read_placement(path)
    former = profile.placement
    moved = any(_part_of(placement.get(name)) != _part_of(former.get(name)) for name in {*placement, *former})
    left: dict[str, object] = {}
    if moved and profile.neutral is not None:
        say("the known neutral face was seen through another placement and is left out: calibrate again")
        left = {"neutral": None, **_NOTHING_READ}
    return profile.model_copy(update={"placement": placement, **left})


def _part_of(placement: "CameraPlacement | None") -> tuple[object, ...]:
    """Which part of its camera's pictures counts, without their levels; all of them without a placement."""
    from regress.runtime.headset.pictures.placement import CameraPlacement

    seen = placement or CameraPlacement()
    return (seen.x, seen.y, seen.size, seen.roll_deg, seen.mirror, seen.stretch, seen.cut)


def _use_or_leave_out_neutral(profile: Profile, pipeline: "Pipeline", say: Callable[[str], None]) -> Profile:
    """Use the profile's neutral face; the profile without it where that cannot be.

    To calibrate again is what helps then, and is not refused.
    """
    try:
        pipeline.use_neutral(profile.neutral)
    except InputError as error:
        say(f"the known neutral face is left out: {error}")
        return profile.model_copy(update={"neutral": None, **_NOTHING_READ})
    return profile


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
