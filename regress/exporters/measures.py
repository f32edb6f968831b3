"""How 68 points become the numbers that networks see, as plain arrays: a turn undone, a map, lengths or points."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import FACE_WIDTH_LANDMARKS, LANDMARK_COUNT
from regress.runtime.features import ANCHORS, STABLE, Features, turn_weights


@dataclass(frozen=True, kw_only=True)
class Measures:
    """What it takes to measure a face.

    Parameters
    ----------
    depth, turn : (68,) float64
        What undoes a turn of the head; zeros where it is left.
    alignment
        ``"affine"`` or ``"none"``: features are lengths of edges. ``"stable"``: they are the points themselves.
    anchors : (A,) int64
        Landmarks that are aligned.
    reference : (A, 2) float64
        Where the anchors are in the mean shape, about their own mean.
    edges : (E, 2) int64
        Pairs of landmarks; none where features are points.
    width_landmarks : (2,) int64
    """

    depth: np.ndarray
    turn: np.ndarray
    alignment: str
    anchors: np.ndarray
    reference: np.ndarray
    edges: np.ndarray
    width_landmarks: np.ndarray

    @property
    def of_points(self) -> bool:
        """Whether features are points, and not lengths."""
        return self.alignment == "stable"

    @property
    def count(self) -> int:
        """How many features a face has."""
        return 2 * LANDMARK_COUNT if self.of_points else len(self.edges)

    def as_json(self) -> dict[str, list | str]:
        """JSON data of all of it."""
        return {
            "depth": self.depth.tolist(),
            "turn": self.turn.tolist(),
            "alignment": self.alignment,
            "anchors": self.anchors.tolist(),
            "reference": self.reference.tolist(),
            "edges": self.edges.tolist(),
            "width_landmarks": self.width_landmarks.tolist(),
        }


def measures_of(features: Features) -> Measures:
    """Write a model's way of measuring down."""
    anchors = STABLE if features.of_points else ANCHORS
    reference = features.mean_shape[list(anchors)]
    depth = np.zeros(LANDMARK_COUNT) if features.depth is None else features.depth
    return Measures(
        depth=depth,
        turn=turn_weights(features.mean_shape, depth) if depth.any() else depth,
        alignment=features.alignment,
        anchors=np.array(anchors, dtype=np.int64),
        reference=reference - reference.mean(axis=0),
        edges=features.edges,
        width_landmarks=np.array(FACE_WIDTH_LANDMARKS, dtype=np.int64),
    )


def place_of(features: Features) -> np.ndarray | float:
    """What `Measures` leave out of each feature: points are measured from the mean of their anchors, (136,) or 0."""
    if not features.of_points:
        return 0.0
    return np.tile(features.mean_shape[list(STABLE)].mean(axis=0), LANDMARK_COUNT)
