"""Measures edge lengths in face widths."""

import numpy as np

from facegen.conventions import FACE_WIDTH_LANDMARKS


def edge_distances(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Length of every edge divided by the face's width.

    Parameters
    ----------
    points : (n, 68, 2) float64
    edges : (E, 2) int
        Landmark indices.

    Returns
    -------
    (n, E) float64
        In face widths. NaN where a face has NaN points or no width.
    """
    right, left = FACE_WIDTH_LANDMARKS
    width = np.hypot(*np.moveaxis(points[:, left] - points[:, right], -1, 0))
    ends = points[:, edges[:, 1]] - points[:, edges[:, 0]]
    lengths = np.hypot(ends[..., 0], ends[..., 1])
    return lengths / np.where(width > 0, width, np.nan)[:, None]
