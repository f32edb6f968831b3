"""Hair as geometry: single curved strands, tapering to their tips."""

import numpy as np

TUBE_SIDES = 3
"""Of a strand's cross-section; at a fifth of a pixel it might as well be round."""


def strand_tubes(
    centres: np.ndarray, radius: np.ndarray, *, sides: int = TUBE_SIDES, axis: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Tubes around polylines.

    Parameters
    ----------
    centres
        (n, k, 3) points from root to tip, metres.
    radius
        (n, k) metres.
    sides
        Of the cross-section.
    axis
        (3,) that no polyline runs along, where they turn; one of the frame's, each its own, if it is not given.

    Returns
    -------
    vertices : numpy.ndarray
        (n * k * sides, 3).
    quads : numpy.ndarray
        (n * (k - 1) * sides, 4) int32, outsides out; the ends are open.
    """
    strands, points = centres.shape[:2]
    along = np.gradient(centres, axis=1)
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    # across the axis that a strand runs along least, so that no tube is twisted or flat
    if axis is None:
        axis = np.eye(3)[np.abs(along.mean(axis=1)).argmin(axis=-1)][:, None]
    first = np.cross(along, axis)
    first /= np.linalg.norm(first, axis=-1, keepdims=True)
    second = np.cross(along, first)
    turn = np.arange(sides) * (2.0 * np.pi / sides)
    ring = np.cos(turn)[:, None] * first[:, :, None] + np.sin(turn)[:, None] * second[:, :, None]
    vertices = centres[:, :, None] + radius[:, :, None, None] * ring
    number = np.arange(strands * points * sides).reshape(strands, points, sides)
    here, ahead = number[:, :-1], number[:, 1:]
    quads = np.stack([here, np.roll(here, -1, axis=2), np.roll(ahead, -1, axis=2), ahead], axis=-1)
    return vertices.reshape(-1, 3), quads.reshape(-1, 4).astype(np.int32)
