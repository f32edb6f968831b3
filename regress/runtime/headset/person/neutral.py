"""Reads neutral pictures of a person: from a frame by its number, from files, or from the calmest frame."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regress.errors import InputError
from regress.runtime.calm import calm_frames
from regress.runtime.headset.pictures.picture_file import PICTURES, read_picture
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.recordings.footage import Footage
from regress.runtime.headset.recordings.recorded_paths import whole_of

_AGREEMENT = 0.15
"""Mean difference of weights, over the shapes that move, by which early and late calm frames may differ."""

_MOVING = 0.02
"""Standard deviation of a weight over the usable frames above which its shape moves."""


@dataclass(frozen=True, kw_only=True)
class NeutralFrame:
    """Which frame of a recording looks neutral, and whether that can be relied on.

    Parameters
    ----------
    row
        Of the footage.
    sure
        Whether there are enough calm frames, and they agree.
    reason
        Why, in a sentence.
    """

    row: int
    sure: bool
    reason: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Neutral:
    """Neutral pictures that count from a frame on.

    Parameters
    ----------
    row
        Of the footage.
    pictures
        (h, w) uint8 of every camera in use.
    """

    row: int
    pictures: dict[str, np.ndarray]


def calmest_frame(weights: np.ndarray, usable: np.ndarray) -> NeutralFrame:
    """Choose the frame of a recording of one person that is nearest to the median of the calm frames.

    Parameters
    ----------
    weights : (n, 52) float
        Without calibration, in the order of time.
    usable : (n,) bool
        Frames in which every given camera has a picture.

    Raises
    ------
    InputError
        Where no frame is usable.
    """
    rows = np.flatnonzero(usable)
    if not len(rows):
        raise InputError("no frame has a picture of every camera, so none can be the neutral one")
    weights = np.asarray(weights, dtype=np.float64)
    moving = weights[rows].std(axis=0) > _MOVING

    def difference(early: np.ndarray, late: np.ndarray) -> float:
        before, after = (np.median(weights[half], axis=0) for half in (early, late))
        return float(np.abs(before - after)[moving].mean()) if moving.any() else 0.0

    calm = calm_frames(weights[rows].sum(axis=1), rows, difference=difference, agreement=_AGREEMENT)
    quiet = weights[calm.frames]
    nearest = np.argmin(np.abs(quiet - np.median(quiet, axis=0)).sum(axis=1))
    return NeutralFrame(row=int(calm.frames[nearest]), sure=calm.sure, reason=calm.reason)


def read_neutral(
    folder: Path,
    cameras: Mapping[str, tuple[int, int]],
    *,
    bits: int | None = None,
    placement: Mapping[str, CameraPlacement] | None = None,
) -> dict[str, np.ndarray]:
    """Neutral pictures from a folder with ``CAMERA.png`` for each camera, as a rendered sample's folder has.

    Parameters
    ----------
    folder
        Another ending of pictures will do too.
    cameras
        Width and height of those that are needed.
    bits
        How many of their 16 bits the cameras use, of pictures that have so many.
    placement
        What of the cameras' pictures the network is to see, of those of which it is not all.

    Returns
    -------
    dict of (h, w) uint8

    Raises
    ------
    InputError
        Where a camera's picture is lacking or shows nothing.
    """
    pictures = {}
    for name, (width, height) in cameras.items():
        files = [folder / f"{name}{suffix}" for suffix in PICTURES]
        path = next((file for file in files if file.is_file()), None)
        if path is None:
            raise InputError(f"{folder} has no neutral picture of {name}; {files[0].name} is looked for")
        placed = (placement or {}).get(name) or whole_of(path, (width, height))
        fitted = read_picture(path, width=width, height=height, bits=bits, placement=placed)
        if fitted.fault is not None:
            raise InputError(f"{path} cannot be the neutral picture of {name}: it is {fitted.fault.value}")
        pictures[name] = fitted.picture
    return pictures


def neutral_of_frame(footage: Footage, row: int) -> dict[str, np.ndarray]:
    """Pictures (h, w) of the cameras that are in use, from one frame of the footage.

    Raises
    ------
    InputError
        Where a camera that other frames have is at fault in this one.
    """
    given = footage.given
    for name, there in zip(footage.cameras, given, strict=True):
        fault = footage.faults[name][row]
        if there and fault is not None:
            raise InputError(
                f"frame {footage.numbers[row]} cannot be the neutral one: {name} has {fault.value} there"
            )
    return {
        name: footage.pictures[name][row] for name, there in zip(footage.cameras, given, strict=True) if there
    }
