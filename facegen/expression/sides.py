"""Draws random numbers whose left and right sides correlate as much as the spec says."""

import numpy as np
import scipy

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, mirrored_name

LEFT: tuple[int, ...] = tuple(
    index
    for index, name in enumerate(BLENDSHAPES)
    if name.endswith("Left") and name not in ("jawLeft", "mouthLeft") and not name.startswith("eyeLook")
)
"""Shapes of the left side. Directions (jawLeft, mouthLeft) and eyes, which move together, stand in neither list."""
RIGHT: tuple[int, ...] = tuple(BLENDSHAPE_INDEX[mirrored_name(BLENDSHAPES[index])] for index in LEFT)
"""Their partners, in the same order."""

_SIDE = np.full((2, len(BLENDSHAPES)), 0.5)
_SIDE[:, LEFT] = [[1.0], [0.0]]
_SIDE[:, RIGHT] = [[0.0], [1.0]]


def draw_sides(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """Uniform numbers (size, 2), left and right with that correlation (0 to 1; 1 gives equal sides)."""
    left, right = rng.random((2, size))
    return np.stack([left, _correlated(left, right, correlation)], axis=-1)


def draw_shapes(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """Uniform numbers (size, 52), one a shape; pairs of shapes have that correlation, all else is independent."""
    unit = rng.random((size, len(BLENDSHAPES)))
    unit[:, RIGHT] = _correlated(unit[:, LEFT], unit[:, RIGHT], correlation)
    return unit


def over_shapes(sides: np.ndarray) -> np.ndarray:
    """Strengths (n, 2) of the sides as strengths (n, 52) of the shapes; shapes of the middle take the mean."""
    return sides[:, :1] * _SIDE[0] + sides[:, 1:] * _SIDE[1]


def _correlated(left: np.ndarray, right: np.ndarray, correlation: float) -> np.ndarray:
    """Uniform numbers that keep to ``left`` by a Gaussian copula, as far as the correlation demands."""
    if correlation == 1:
        return left
    # uniforms correlate by 6/pi asin(r/2) where their Gaussians correlate by r
    r = 2 * np.sin(np.pi / 6 * correlation)
    return scipy.special.ndtr(r * scipy.special.ndtri(left) + np.sqrt(1 - r * r) * scipy.special.ndtri(right))
