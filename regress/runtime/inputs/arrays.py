"""NumPy files of landmarks, (n, 68, 2), (n, 70, 2) with the irises, or a mesh; one face may stand without its n."""

from pathlib import Path

import numpy as np

from facegen.archives import load_npy
from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.frames import MOST_FRAMES, Frames, split_irises
from regress.runtime.inputs.mesh import VERTICES, irises_of, landmarks_of

_MOST_BYTES = MOST_FRAMES * (LANDMARK_COUNT + 2) * 2 * 8
"""Of as many frames as are read, in float64."""


def is_array(path: Path) -> bool:
    """Whether this is an ``.npy`` file."""
    return path.suffix.lower() == ".npy"


def read_array(path: Path) -> Frames:
    """Frames in the array's order; labels count from 0."""
    points = load_npy(path, most_bytes=_MOST_BYTES)
    known = ((LANDMARK_COUNT, 2), (LANDMARK_COUNT + 2, 2), (VERTICES, 2), (VERTICES, 3))
    if points.shape in known:
        points = points[None]
    if points.ndim != 3 or points.shape[1:] not in known or not 0 < len(points) <= MOST_FRAMES:
        raise InputError(
            f"{path} has shape {points.shape}; (n, {LANDMARK_COUNT}, 2) is needed, n from 1 to {MOST_FRAMES:,}, "
            f"or (n, {LANDMARK_COUNT + 2}, 2) with the irises, or (n, {VERTICES}, 2 or 3) of MediaPipe's mesh"
        )
    if points.dtype.kind not in "fiu":
        raise InputError(f"{path} holds {points.dtype}; numbers are needed")
    with np.errstate(invalid="ignore"):  # signalling NaNs are missing points as others are
        points = points.astype(np.float64)
    if points.shape[1] == VERTICES:
        mesh = points[..., :2]
        faces, irises = landmarks_of(mesh), irises_of(mesh)
    else:
        faces, irises = split_irises(points)
    labels = tuple(map(str, range(len(points))))
    return Frames(points=faces, labels=labels, time_s=None, source=str(path), irises=irises)
