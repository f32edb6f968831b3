"""NumPy files of landmarks, (n, k, 2) of any known order (`orders`), or an archive of one; a face needs no n."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from facegen.archives import load_npy, load_npz
from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.frames import FEWEST_PX, MOST_FRAMES, Frames
from regress.runtime.inputs.instances import has_face
from regress.runtime.inputs.orders import BODIES, COUNTS, COUNTS_SAID, split_irises

_MOST_BYTES = MOST_FRAMES * (LANDMARK_COUNT + 2) * 2 * 8
"""Of as many frames as are read, in float64."""


def is_array(path: Path) -> bool:
    """Whether this is an ``.npy`` or ``.npz`` file."""
    return path.suffix.lower() in (".npy", ".npz")


def read_array(path: Path) -> Frames:
    """Frames in the array's order; labels count from 0.

    A third number of a point is a depth, and left alone, or a score as pose estimators give it: a face of low ones is
    none.
    """
    points = _array(path)
    if points.ndim == 2 and len(points) in COUNTS and points.shape[1] in (2, 3):
        points = points[None]
    shaped = points.ndim == 3 and points.shape[1] in COUNTS and points.shape[2] in (2, 3)
    if not shaped or not 0 < len(points) <= MOST_FRAMES:
        raise InputError(
            f"{path} has shape {points.shape}; (n, {LANDMARK_COUNT}, 2) is needed, n from 1 to {MOST_FRAMES:,}, "
            f"or other points of a face: {COUNTS_SAID}"
        )
    if points.dtype.kind not in "fiu":
        raise InputError(f"{path} holds {points.dtype}; numbers are needed")
    with np.errstate(invalid="ignore"):  # signalling NaNs are missing points as others are
        points = points.astype(np.float64)
    faces, irises = split_irises(points[..., :2])
    labels = tuple(map(str, range(len(points))))
    frames = Frames(points=faces, labels=labels, time_s=None, source=str(path), irises=irises)
    if not _has_scores(points, frames):
        return frames
    seen = has_face(split_irises(points)[0][..., 2])[:, None, None]
    irises = None if irises is None else np.where(seen, irises, np.nan)
    return replace(frames, points=np.where(seen, faces, np.nan), irises=irises)


def _has_scores(points: np.ndarray, frames: Frames) -> bool:
    """Whether third numbers of points (n, k, 2 or 3) are scores: of bodies, and from 0 to 1 beside pixels.

    Zeros alone stand where nothing is known.
    """
    third = points[..., 2:]
    third = third[np.isfinite(third)]
    if not third.any():
        return False
    return points.shape[1] in BODIES or (third.min() >= 0 and third.max() <= 1 and frames.extent >= FEWEST_PX)


def _array(path: Path) -> np.ndarray:
    if path.suffix.lower() == ".npy":
        return load_npy(path, most_bytes=_MOST_BYTES)
    arrays = load_npz(path, most_bytes=_MOST_BYTES)
    if len(arrays) != 1:
        names = ", ".join(sorted(arrays)[:5]) or "none"
        raise InputError(
            f"{path} holds {len(arrays)} arrays ({names}); one is needed, of points: save it as .npy"
        )
    return next(iter(arrays.values()))
