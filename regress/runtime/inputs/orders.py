"""Orders in which detectors number the points of a face, told by how many they are: which are iBUG's 68, and irises."""

from collections.abc import Callable

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.runtime.inputs.mesh import IRISLESS, VERTICES, irises_of, landmarks_of

_BODY_FACE = slice(23, 91)
"""Of COCO-WholeBody's 133 points, the face's."""

_HALPE_FACE = slice(26, 94)
"""Of Halpe's 136 points, as AlphaPose writes them, the face's."""

_WFLW = np.array(
    [
        *range(0, 33, 2),  # the jaw, of which WFLW has a point more between two of ours
        *range(33, 38),  # upper edges of the brows
        *range(42, 47),
        *range(51, 60),  # the nose
        *(60, 61, 63, 64, 65, 67),  # eyes without the middles of their lids
        *(68, 69, 71, 72, 73, 75),
        *range(76, 96),  # the mouth
    ]
)
"""Of WFLW's 98 points, iBUG's 68."""

_WFLW_PUPILS = [97, 96]
"""The subject's left one first."""

_Split = tuple[np.ndarray, np.ndarray | None]

_ORDERS: dict[int, Callable[[np.ndarray], _Split]] = {
    LANDMARK_COUNT: lambda points: (points, None),
    LANDMARK_COUNT + 2: lambda points: (
        points[:, :LANDMARK_COUNT],
        points[
            :, [LANDMARK_COUNT + 1, LANDMARK_COUNT]
        ],  # the right iris stands first, as OpenPose writes them
    ),
    98: lambda points: (points[:, _WFLW], points[:, _WFLW_PUPILS]),
    133: lambda points: (points[:, _BODY_FACE], None),
    136: lambda points: (points[:, _HALPE_FACE], None),
    IRISLESS: lambda points: (landmarks_of(points), None),
    VERTICES: lambda points: (landmarks_of(points), irises_of(points)),
}

COUNTS = tuple(_ORDERS)
"""How many points a face may have."""

BODIES = (133, 136)
"""Of these, those of whole bodies, as pose estimators find them."""

COUNTS_SAID = (
    "68 in iBUG's order, 70 with the irises, 98 in WFLW's, 133 or 136 of a whole body (COCO-WholeBody, Halpe), or 468 "
    "or 478 of MediaPipe's mesh"
)
"""The same for people."""


def split_irises(points: np.ndarray) -> _Split:
    """Landmarks (n, 68, 2), and irises (n, 2, 2) where the order has them, the subject's left eye first.

    Parameters
    ----------
    points : (n, k, 2) float64
        Of k in `COUNTS`.
    """
    return _ORDERS[points.shape[1]](points)


def seventy(points: np.ndarray) -> np.ndarray:
    """One face (68 or 70, d) in iBUG's order of its points (k, d) in any: irises stand behind, the right one first."""
    faces, irises = split_irises(points[None])
    return faces[0] if irises is None else np.concatenate([faces[0], irises[0, ::-1]])
