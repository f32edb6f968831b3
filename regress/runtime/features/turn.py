"""Undoes a turn of the head: near points move against far ones, as far as the mean face's depth says."""

import numpy as np

from regress.runtime.features.alignment import ANCHORS
from regress.runtime.features.reference_shape import ReferenceShape


def depths_of(shape: ReferenceShape) -> np.ndarray:
    """How far each landmark of a reference shape stands out (68,), in its widths, about the anchors' mean."""
    points = shape.points
    depth = points[:, 2] / np.ptp(points[:, 0])
    return depth - depth[list(ANCHORS)].mean()


def turn_weights(mean_shape: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """What finds the turn in a face: ``weights @ points`` is how far a point of unit depth has moved.

    A turned, distant face is ``x' = A x + b z + t`` (an affine camera; Hartley and Zisserman, section 6.3.4). With
    x and z of the mean face, least squares over the anchors is linear in the points seen; this is its row for b.

    Parameters
    ----------
    mean_shape : (68, 2) float64
    depth : (68,) float64
        Any unit.

    Returns
    -------
    (68,) float64
        0 but for the anchors; orthogonal to 1 and to both columns of the mean shape, so affine maps of a picture
        commute with undoing the turn.
    """
    anchors = list(ANCHORS)
    design = np.column_stack([mean_shape[anchors], np.ones(len(anchors)), depth[anchors]])
    weights = np.zeros(len(depth))
    weights[anchors] = np.linalg.pinv(design)[3]
    return weights


def undo_turn(points: np.ndarray, mean_shape: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Faces (n, 68, 2) with every point put back by ``b z``; ``A`` and ``t`` are left to the alignment.

    What is left of a turn comes from people's depths differing from the mean face's.
    """
    moved = np.einsum("p,npd->nd", turn_weights(mean_shape, depth), points)
    return points - depth[:, None] * moved[:, None]
