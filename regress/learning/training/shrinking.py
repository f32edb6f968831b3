"""Shrinks movements away from a neutral face, as detectors do: a jaw that opens fully reads half open."""

from functools import lru_cache

import numpy as np

from facegen.conventions import LANDMARK_COUNT, LANDMARK_GROUPS
from regress.runtime.features import depths_of, load_reference_shape

REGIONS: tuple[tuple[int, ...], ...] = (
    LANDMARK_GROUPS["jaw"],
    (*LANDMARK_GROUPS["right_brow"], *LANDMARK_GROUPS["left_brow"]),
    (*LANDMARK_GROUPS["right_eye"], *LANDMARK_GROUPS["left_eye"]),
    (*LANDMARK_GROUPS["outer_lip"], *LANDMARK_GROUPS["inner_lip"]),
)
"""Landmarks that a detector shrinks alike; the nose hardly moves."""

_STILL = [0, 1, 2, 14, 15, 16, *LANDMARK_GROUPS["nose_bridge"], 36, 39, 42, 45]
"""The contour before the ears, the bridge of the nose and the corners of the eyes. The nose's base, which goes aside
with the mouth, would pass for a turn. A neutral head laid by these misses the turned one by 1 % of the outer eyes'
distance at 12 degrees, and by as much where mouth or jaw move by 7 to 12 %.
"""


def draw_gains(rng: np.random.Generator, count: int, *, least: float) -> np.ndarray:
    """How much of a movement ``count`` detectors show (count, 68, 1): by region, log-uniform from ``least`` to 1."""
    gains = np.ones((count, LANDMARK_COUNT, 1))
    for region in REGIONS:
        gains[:, list(region)] = np.exp(rng.uniform(np.log(least), 0.0, (count, 1, 1)))
    return gains


def shrink(points: np.ndarray, neutral: np.ndarray, gains: np.ndarray) -> np.ndarray:
    """Faces (n, 68, 2) whose way from their neutral faces (n, 68, 2) is shortened by gains (n, 68, 1 or 2)."""
    there = as_turned(neutral, points)
    return there + gains * (points - there)


def as_turned(neutral: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Neutral faces (n, 68, 2) as the heads of other faces (n, 68, 2) are turned.

    A turned, distant head is ``x' = A x + b z + t`` (``regress.runtime.features.turn``): least squares over points that
    expressions hardly move, with each person's own x and y and the mean face's z.
    """
    depth = np.broadcast_to(_depth(), (*neutral.shape[:2], 1))
    design = np.concatenate([neutral, depth, np.ones_like(depth)], axis=2)
    # in the neutral face's own size, so that no column drowns another
    design[..., :2] = (design[..., :2] - neutral.mean(axis=1, keepdims=True)) / neutral.std()
    return design @ (np.linalg.pinv(design[:, _STILL]) @ points[:, _STILL])


@lru_cache
def _depth() -> np.ndarray:
    """(68, 1) of the mean face, in its widths."""
    return depths_of(load_reference_shape())[:, None]
