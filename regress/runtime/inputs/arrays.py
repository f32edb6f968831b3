"""NumPy files of landmarks, (n, 68, 2)."""

from pathlib import Path

import numpy as np

from facegen.archives import load_npy
from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.frames import MOST_FRAMES, Frames

_MOST_BYTES = MOST_FRAMES * LANDMARK_COUNT * 2 * 8
"""Of as many frames as are read, in float64."""


def is_array(path: Path) -> bool:
    """Whether this is an ``.npy`` file."""
    return path.suffix.lower() == ".npy"


def read_array(path: Path) -> Frames:
    """Frames in the array's order; labels count from 0."""
    points = load_npy(path, most_bytes=_MOST_BYTES)
    if points.ndim != 3 or points.shape[1:] != (LANDMARK_COUNT, 2) or not 0 < len(points) <= MOST_FRAMES:
        raise InputError(
            f"{path} has shape {points.shape}; (n, {LANDMARK_COUNT}, 2) is needed, n from 1 to {MOST_FRAMES:,}"
        )
    if points.dtype.kind not in "fiu":
        raise InputError(f"{path} holds {points.dtype}; numbers are needed")
    with np.errstate(invalid="ignore"):  # signalling NaNs are missing points as others are
        points = points.astype(np.float64)
    return Frames(points=points, labels=tuple(map(str, range(len(points)))), time_s=None, source=str(path))
