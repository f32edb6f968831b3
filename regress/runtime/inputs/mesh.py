"""Turns MediaPipe's face mesh, 478 points or 468 without irises, into 68 landmarks and irises."""

from functools import cache
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_GROUPS
from facegen.documents import load_json

VERTICES = 478
"""Of the mesh with irises."""

IRISLESS = 468
"""Of the mesh without them, whose vertices have the same numbers: irises stand behind."""

_TABLE = Path(__file__).parents[2] / "data" / "mediapipe_points.json"


@cache
def _table() -> tuple[np.ndarray, np.ndarray, list[int]]:
    """First and second vertex of each landmark, often the same one, and the irises' vertices, the left eye's first."""
    table = load_json(_TABLE)
    vertices = [each for group in LANDMARK_GROUPS for each in table["landmarks"][group]]
    return (
        np.array([each[0] for each in vertices]),
        np.array([each[-1] for each in vertices]),
        [table["irises"]["left"], table["irises"]["right"]],
    )


def landmarks_of(mesh: np.ndarray) -> np.ndarray:
    """68 landmarks (..., 68, 2) of a mesh (..., 468 or 478, 2), in the mesh's units."""
    first, second, _ = _table()
    return (mesh[..., first, :] + mesh[..., second, :]) / 2


def irises_of(mesh: np.ndarray) -> np.ndarray:
    """Centres of the irises (..., 2, 2), the subject's left eye first, of a mesh (..., 478, 2)."""
    return mesh[..., _table()[2], :]
