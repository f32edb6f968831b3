"""Extracts the features of a model: which alignment, which edges."""

from dataclasses import dataclass

import numpy as np

from regress.runtime.features.alignment import align_affine
from regress.runtime.features.distances import edge_distances
from regress.runtime.features.turn import undo_turn

ALIGNMENTS = ("affine", "none")
"""``affine``: to the mean shape by the anchors; ``none``: lengths over width ignore place, size and roll."""


@dataclass(frozen=True, kw_only=True)
class Features:
    """How a model turns 68 points into numbers.

    Parameters
    ----------
    alignment
        One of ``ALIGNMENTS``.
    mean_shape : (68, 2) float64
        What the affine alignment aims at: face width 1, y down.
    edges : (E, 2) int64
        Landmark indices, sorted.
    reference_name, reference_sha256
        The reference shape that the edges came from.
    depth : (68,) float64 or None
        How far the mean face's points stand out, face widths; a turn of the head is undone by it before the
        alignment. None: it is not.
    """

    alignment: str
    mean_shape: np.ndarray
    edges: np.ndarray
    reference_name: str
    reference_sha256: str
    depth: np.ndarray | None = None


def extract(features: Features, points: np.ndarray) -> np.ndarray:
    """Raw features of faces, before z-scoring.

    Parameters
    ----------
    points : (n, 68, 2) float64
        Faces in any unit; a face with NaN gives a row of NaN.

    Returns
    -------
    (n, E) float64
        Edge lengths in face widths.
    """
    if features.depth is not None:
        points = undo_turn(points, features.mean_shape, features.depth)
    if features.alignment == "affine":
        points = align_affine(points, features.mean_shape)
    distances = edge_distances(points, features.edges)
    # One missing point makes the face unusable even where no edge ends in it: there is no such point today.
    distances[~np.isfinite(distances).all(axis=1)] = np.nan
    return distances
