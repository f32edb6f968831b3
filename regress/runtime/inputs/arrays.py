"""NumPy files of landmarks, (n, 68, 2)."""

from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames


def is_array(path: Path) -> bool:
    """Whether this is an ``.npy`` file."""
    return path.suffix.lower() == ".npy"


def read_array(path: Path) -> Frames:
    """Frames in the array's order; labels count from 0."""
    try:
        points = np.load(path, allow_pickle=False)
    except (ValueError, EOFError) as error:
        raise InputError(f"{path} is not a readable .npy file: {error}") from error
    if points.ndim != 3 or points.shape[1:] != (LANDMARK_COUNT, 2) or not len(points):
        raise InputError(f"{path} has shape {points.shape}; (n, {LANDMARK_COUNT}, 2) is needed, n at least 1")
    if points.dtype.kind not in "fiu":
        raise InputError(f"{path} holds {points.dtype}; numbers are needed")
    points = points.astype(np.float64)
    return Frames(points=points, labels=tuple(map(str, range(len(points)))), time_s=None, source=str(path))
