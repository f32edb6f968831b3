"""Measures how wide a pupil is, as a share of its iris, in a picture whose iris and pupil are traced.

Rings like the iris, about the pupil's middle, go from dark to light where the pupil ends. The iris is nearly the same
in all people ([1]_), so the share needs no camera's model: both are seen through one cornea and from one side.

References
----------
.. [1] F. Rüfer et al., "White-to-white corneal diameter", Cornea 24(3), 2005.
"""

import cv2
import numpy as np

from regress.runtime.headset.eyes.eye_points import EyePoints

_RADII = np.linspace(0.1, 0.86, 39)
"""Of rings, in radii of the iris: the limbus is blurred beyond."""

_TURNS = 32
"""Spots of a ring: as many as pixels of an iris of 10 pixels' radius."""


def _around(count: int) -> np.ndarray:
    """Directions (count, 2), evenly about a middle."""
    turns = 2 * np.pi * np.arange(count) / count
    return np.column_stack([np.cos(turns), np.sin(turns)])


_RINGS = _RADII[:, None, None] * _around(_TURNS)
"""Spots (rings, turns, 2) about the middle of a round iris of radius 1."""

_LEAST_SEEN = 10
"""Spots of a ring between the lids whose median is a ring's level: a third of it."""

_LEAST_CONTRAST = 5.0
"""Grey levels between pupil and iris: fewer are grain."""

_LEAST_RINGS = 24
"""That are seen: up to three fifths of the iris, for a pupil that ends where the lids do is none."""

_EDGE_RINGS = 3
"""From either end, in which no edge is looked for: a level needs so many rings."""


def pupil_share(picture: np.ndarray, points: np.ndarray, eye: EyePoints) -> float:
    """Diameter of the pupil over that of the iris; NaN where lids or light do not let it be seen.

    Parameters
    ----------
    picture : (h, w) uint8
        As the network sees it.
    points : (P, 2)
        Pixels of what the camera traces.
    """
    iris = points[eye.iris]
    if not np.isfinite(points).all():
        return float("nan")
    axes = 2 / len(iris) * _around(len(iris)).T @ (iris - iris.mean(axis=0))
    spots = (points[eye.pupil] + _RINGS @ axes).astype(np.float32)
    levels = cv2.remap(
        picture, spots[..., 0], spots[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    ).astype(np.float64)
    between = _between_lids(spots, points, eye, picture.shape)
    levels[~between] = np.nan
    counts = between.sum(axis=1)
    seen = counts >= _LEAST_SEEN
    # the median is blind to glints, which cover a few spots of a ring
    return _edge(_RADII[seen], _medians(levels[seen], counts[seen])) if seen.sum() >= _LEAST_RINGS else np.nan


def _between_lids(
    spots: np.ndarray, points: np.ndarray, eye: EyePoints, shape: tuple[int, ...]
) -> np.ndarray:
    """Which spots (..., 2) of a picture of this shape lie between the lids, and in the picture."""
    outline = np.concatenate([points[eye.upper], points[eye.lower][::-1]])
    mask = cv2.fillPoly(np.zeros(shape, np.uint8), [np.rint(outline).astype(np.int32)], 1)
    at = np.rint(spots)
    # beyond the picture is no lid: its edge is 0
    return cv2.remap(mask, at[..., 0], at[..., 1], cv2.INTER_NEAREST, borderValue=0) > 0


def _medians(levels: np.ndarray, count: np.ndarray) -> np.ndarray:
    """(n,) of what is seen of rings (n, k), count (n,) of each: NaN sorts last. A twentieth of NumPy's own time."""
    ordered, rows = np.sort(levels, axis=1), np.arange(len(levels))
    return (ordered[rows, (count - 1) // 2] + ordered[rows, count // 2]) / 2


def _edge(radii: np.ndarray, levels: np.ndarray) -> float:
    """Radius at which levels (n,) change from dark to light: two levels, each ring counting by its length."""
    count = radii.cumsum()
    sums, squares = (radii * levels).cumsum(), (radii * levels**2).cumsum()
    split = np.arange(_EDGE_RINGS, len(radii) - _EDGE_RINGS)
    dark = sums[split] / count[split]
    light = (sums[-1] - sums[split]) / (count[-1] - count[split])
    left_over = squares[-1] - count[split] * dark**2 - (count[-1] - count[split]) * light**2
    best = int(np.argmin(left_over))
    if light[best] - dark[best] < _LEAST_CONTRAST:
        return float("nan")
    middle = (dark[best] + light[best]) / 2
    # the crossing between two rings that is nearest to the split
    crossed = np.flatnonzero((levels[:-1] <= middle) & (levels[1:] > middle))
    if not len(crossed):
        return float(radii[split[best]])
    ring = crossed[np.argmin(np.abs(crossed - split[best]))]
    share = (middle - levels[ring]) / (levels[ring + 1] - levels[ring])
    return float(radii[ring] + share * (radii[ring + 1] - radii[ring]))
