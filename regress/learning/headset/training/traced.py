"""Chooses the points that a camera's network traces, and finds them in the squares that it sees."""

import numpy as np

from facegen.conventions import MIRRORED_VIEW_POINTS
from regress.learning.headset.arrays import HeadsetArrays
from regress.runtime.headset.network.parts import encoder_owners

SEEN = 1 / 3
"""Share of training frames whose picture must show a point for its camera to trace it: inner lips show in a third."""

_MIRROR = np.array(MIRRORED_VIEW_POINTS)


def traced_points(arrays: HeadsetArrays, rows: np.ndarray) -> dict[str, np.ndarray]:
    """Indices (P,) into ``VIEW_POINTS`` for each camera that has its own encoder.

    Pictures of a camera that shares another's encoder count with it, mirrored.
    """
    seen: dict[str, list[np.ndarray]] = {}
    owners = encoder_owners(tuple(camera.name for camera in arrays.cameras))
    for camera in arrays.cameras:
        points = arrays.points[camera.name][rows]
        with np.errstate(invalid="ignore"):  # NaN: not shown
            inside = ((points > -0.5) & (points < np.array([camera.width, camera.height]) - 0.5)).all(axis=-1)
        owner = owners[camera.name]
        seen.setdefault(owner or camera.name, []).append(inside if owner is None else inside[:, _MIRROR])
    return {name: np.flatnonzero(np.concatenate(found).mean(axis=0) >= SEEN) for name, found in seen.items()}


def positions_of(
    points: np.ndarray, traced: np.ndarray, warps: np.ndarray, *, scale: np.ndarray, size: int
) -> np.ndarray:
    """Where traced points lie in an encoder's squares, (n, P, 2) float32: 0 to 1 across and down, NaN beyond.

    Parameters
    ----------
    points : (n, 120, 2)
        ``VIEW_POINTS`` in pixels of the camera's whole pictures.
    traced : (n, P)
        Indices into them.
    warps : (n, 2, 3)
        From the square's pixels to those of the reduced picture.
    scale : (n, 2)
        The reduced picture's width and height as shares of the whole one's.
    size
        Of the square.
    """
    chosen = np.take_along_axis(points, traced[..., None], axis=1)
    reduced = (chosen + 0.5) * scale[:, None] - 0.5
    turned = np.linalg.inv(warps[:, :, :2])
    positions = (np.einsum("nij,npj->npi", turned, reduced - warps[:, None, :, 2]) + 0.5) / size
    with np.errstate(invalid="ignore"):
        inside = ((positions > 0) & (positions < 1)).all(axis=-1, keepdims=True)
    return np.where(inside, positions, np.nan).astype(np.float32)


def mirrored_points(traced: np.ndarray) -> np.ndarray:
    """Indices of the same points of the mirrored face."""
    return _MIRROR[traced]
