"""What is wrong with a camera's pictures: none, unreadable, of another shape, black, of one grey, frozen."""

from collections.abc import Mapping, Sequence
from enum import Enum

import numpy as np

from regress.runtime.inputs import joined_runs

DARK = 24
"""Grey level that the brightest fiftieth of a black picture stays below.

Rendered views have 124 and more there (41 samples of `tracking3`, black level 8); a lens cap and sensor noise have less
than 20.
"""

FLAT = 4.0
"""Standard deviation in grey levels below which a picture shows nothing; rendered views have 32 and more."""

STILL = 0.1
"""Mean difference in grey levels up to which two pictures are the same one.

Sensor noise alone makes more than 1; a film's encoder leaves less than this between repeats of one picture.
"""

FROZEN_FRAMES = 8
"""Repeats of a picture beyond which its camera is frozen if others go on: a quarter of a second at 30 a second."""

_TOLD_RUNS = 8
"""Runs of frames that a sentence lists; the count in front of them is of all."""


class Fault(Enum):
    """What is wrong with a camera in a frame; the value says what it has there."""

    MISSING = "no picture"
    UNREADABLE = "a file that is no picture"
    SHAPE = "a picture of another shape"
    BLACK = "a black picture"
    FLAT = "a picture of one grey"
    FROZEN = "the picture of before again, while other cameras go on"


def picture_fault(picture: np.ndarray) -> Fault | None:
    """What is wrong with a picture (h, w) uint8 by itself."""
    if np.percentile(picture, 98) < DARK:
        return Fault.BLACK
    return Fault.FLAT if picture.std() < FLAT else None


def frozen_frames(
    pictures: Mapping[str, np.ndarray], present: Mapping[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """Frames in which each camera repeats a picture while another moves.

    A run of repeats counts, all of it but its first picture, where it is longer than `FROZEN_FRAMES` and another
    camera has changed in its course. A recording of one camera has no others, and is never called frozen.

    Parameters
    ----------
    pictures
        (n, h, w) uint8 of each camera, in the order of time.
    present
        (n,) bool of each: whether there is a picture.

    Returns
    -------
    dict of (n,) bool
    """
    repeats = {name: _repeats(pictures[name], present[name]) for name in pictures}
    frozen = {}
    for name, repeated in repeats.items():
        others = [present[other] & ~repeats[other] for other in pictures if other != name]
        moving = np.any(others, axis=0) if others else np.zeros(len(repeated), dtype=bool)
        frozen[name] = np.zeros(len(repeated), dtype=bool)
        for start, stop in _runs(repeated):
            if stop - start > FROZEN_FRAMES and moving[start:stop].any():
                frozen[name][start:stop] = True
    return frozen


def told_faults(camera: str, numbers: Sequence[int], faults: Sequence[Fault | None]) -> list[str]:
    """A sentence a kind of fault: how many of a camera's frames, and which, by their numbers."""
    lines = []
    for fault in Fault:
        frames = [int(number) for number, found in zip(numbers, faults, strict=True) if found is fault]
        if frames:
            which = "all of them" if len(frames) == len(faults) else _listed(frames)
            lines.append(f"{camera}: {len(frames)} of {len(faults)} frames have {fault.value}: {which}")
    return lines


def _listed(frames: list[int]) -> str:
    runs = joined_runs(frames).split(", ")
    if len(runs) <= _TOLD_RUNS:
        return ", ".join(runs)
    return f"{', '.join(runs[:_TOLD_RUNS])} and {len(runs) - _TOLD_RUNS} more"


def _repeats(pictures: np.ndarray, present: np.ndarray) -> np.ndarray:
    """Whether each picture is the one before it; compared with the first of a run, so that slow drift is none."""
    repeated = np.zeros(len(pictures), dtype=bool)
    first = None
    for row, there in enumerate(present):
        if not there:
            first = None
        elif first is not None and _same(pictures[first], pictures[row]):
            repeated[row] = True
        else:
            first = row
    return repeated


def _same(one: np.ndarray, other: np.ndarray) -> bool:
    return float(np.abs(one.astype(np.int16) - other).mean()) <= STILL


def _runs(flags: np.ndarray) -> list[tuple[int, int]]:
    """Starts and stops of runs of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(np.int8)))
    return [(int(start), int(stop)) for start, stop in edges.reshape(-1, 2)]
