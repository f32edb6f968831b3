"""Extracts the features of a model: lengths between aligned points, or the aligned points themselves."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import LANDMARK_COUNT, MIRRORED_LANDMARKS
from regress.runtime.features.alignment import STABLE, align_affine, align_similarity
from regress.runtime.features.distances import edge_distances
from regress.runtime.features.reference_shape import mirrored_edges
from regress.runtime.features.turn import undo_turn

ALIGNMENTS = ("affine", "none", "stable")
"""``affine``: to the mean shape by the anchors; ``none``: lengths over width ignore place, size and roll; ``stable``:
the points themselves, turned, scaled and shifted onto the mean shape by those that expressions hardly move."""


@dataclass(frozen=True, kw_only=True)
class Features:
    """How a model turns 68 points into numbers.

    Parameters
    ----------
    alignment
        One of ``ALIGNMENTS``. Behind ``stable`` the features are the points, x and y of each; else they are lengths.
    mean_shape : (68, 2) float64
        What the alignment aims at: face width 1, y down.
    edges : (E, 2) int64
        Landmark indices, sorted; none behind ``stable``.
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

    @property
    def of_points(self) -> bool:
        """Whether the features are points, and not lengths."""
        return self.alignment == "stable"

    @property
    def count(self) -> int:
        """How many numbers a face becomes."""
        return 2 * LANDMARK_COUNT if self.of_points else len(self.edges)

    @property
    def mirror(self) -> tuple[np.ndarray, np.ndarray]:
        """Of each feature (E,) the one that it becomes in the mirror, and the sign: differences of x turn over."""
        if not self.of_points:
            partners = mirrored_edges(self.edges)
            return partners, np.ones(len(partners))
        partners = 2 * np.asarray(MIRRORED_LANDMARKS)[:, None] + [0, 1]
        return partners.ravel(), np.tile([-1.0, 1.0], LANDMARK_COUNT)


def extract(features: Features, points: np.ndarray) -> np.ndarray:
    """Raw features of faces, before z-scoring.

    Parameters
    ----------
    points : (n, 68, 2) float64
        Faces in any unit; a face with NaN gives a row of NaN.

    Returns
    -------
    (n, E) float64
        Lengths, or x and y, in face widths.
    """
    if features.depth is not None:
        points = undo_turn(points, features.mean_shape, features.depth)
    if features.of_points:
        values = align_similarity(points, features.mean_shape, STABLE).reshape(
            len(points), 2 * LANDMARK_COUNT
        )
    else:
        if features.alignment == "affine":
            points = align_affine(points, features.mean_shape)
        values = edge_distances(points, features.edges)
    # one missing point makes the face unusable, also where nothing is measured from it
    values[~np.isfinite(values).all(axis=1)] = np.nan
    return values
