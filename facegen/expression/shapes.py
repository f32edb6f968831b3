"""Draws faces that combine shapes blindly: every combination is shown some time.

Where a draw sets eyeLook* weights, they are a wish: the gaze turns both eyes there (see `mixture`).
"""

import numpy as np

from facegen.conventions import (
    BLENDSHAPE_INDEX,
    BLENDSHAPES,
    BLINK_INDICES,
    EYE_LOOK_INDICES,
    MIRRORED_BLENDSHAPES,
)
from facegen.expression.couplings import TONGUE_NEEDS_JAW
from facegen.expression.sides import LEFT, RIGHT, draw_shapes, draw_sides
from facegen.expression.templates import CLOSING

SPARSE_SHAPES = (1, 6)
"""Fewest and most shapes of a sparse face; a pair counts once."""
DENSE_SHARE, DENSE_STRENGTH = 0.35, 0.7
"""Share of the shapes that move in a dense face, and the strongest weight there."""
REGION_SHARE = 0.35
"""Share of a region's shapes that move in a face of one region."""
UPPER_FACE = ("brow", "eye", "noseSneer", "cheekSquint")
"""How the names of the shapes begin that the cameras at the eyes see; all others are the lower face."""
COMBINED_JAW, COMBINED_BLINK = 0.35, (0.3, 0.8)
"""Least jawOpen of a combined face, and from where to where both eyes are closed."""
WINK_FULL, WINK_BOTH = 0.5, 0.35
"""Shares of winking faces whose lids meet, and of those that shut both eyes."""
TONGUE_NONE, TONGUE_FULL, TONGUE_OTHERS = 1 / 3, 0.5, 0.15
"""Shares of a tongue's faces without it, of the others those that put it out fully, and of shapes that move beside."""
EXTREME_SHAPES, EXTREME_FROM, EXTREME_GAZE = 3, 0.75, 0.25
"""Shapes of an extreme face, the weakest weight there, and the share of faces with eyes turned as far."""

_JAW, _TONGUE = BLENDSHAPE_INDEX["jawOpen"], BLENDSHAPE_INDEX["tongueOut"]
_FIRST = np.setdiff1d(np.arange(len(BLENDSHAPES)), (*RIGHT, *EYE_LOOK_INDICES))
"""Every pair once, and the shapes without a side; eyes are turned by the gaze."""
_IS_UPPER = np.array([BLENDSHAPES[index].startswith(UPPER_FACE) for index in _FIRST])
_WIDES = [BLENDSHAPE_INDEX["eyeWide" + side] for side in ("Left", "Right")]


def draw_single(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """One shape, or a pair, through its whole range; mouthClose and tongueOut bring the jaw along.

    With it only what it cannot do without.
    """
    shape = rng.integers(0, len(BLENDSHAPES), size)
    is_pair = rng.random(size) < correlation
    strength = draw_sides(rng, size, correlation=correlation)
    jaw = rng.random(size)
    weights = np.zeros((size, len(BLENDSHAPES)))
    row = np.arange(size)
    weights[row, shape] = strength[:, 0]
    pair = np.flatnonzero(is_pair & np.isin(shape, (*LEFT, *RIGHT)))
    weights[pair, np.array(MIRRORED_BLENDSHAPES)[shape[pair]]] = strength[pair, 1]
    # mouthClose alone sweeps jawOpen under closed lips; the tongue needs an open mouth
    closing = shape == CLOSING
    weights[closing, _JAW] = weights[closing, CLOSING]
    weights[closing, CLOSING] = 1.0
    tongue = shape == _TONGUE
    weights[tongue, _JAW] = TONGUE_NEEDS_JAW + 0.01 + (0.99 - TONGUE_NEEDS_JAW) * jaw[tongue]
    return weights


def draw_sparse(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """One to six shapes, independent of each other, through their whole range."""
    fewest, most = SPARSE_SHAPES
    count = rng.integers(fewest, most + 1, size)
    # the count-th smallest of random numbers bounds the chosen ones
    key = rng.random((size, len(_FIRST)))
    bound = np.take_along_axis(np.partition(key, range(most), axis=1), count[:, None] - 1, axis=1)
    return _draw_active(rng, key <= bound, correlation=correlation)


def draw_dense(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """About a third of all shapes, independent of each other, up to 0.7."""
    weights = _draw_active(rng, rng.random((size, len(_FIRST))) < DENSE_SHARE, correlation=correlation)
    closing = weights[:, CLOSING].copy()
    weights *= DENSE_STRENGTH
    weights[:, CLOSING] = closing
    return weights


def draw_extreme(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """Three shapes at 0.75 or more, the eyes turned as far now and then; subtle faces among them are scaled down."""
    key = rng.random((size, len(_FIRST)))
    bound = np.partition(key, EXTREME_SHAPES - 1, axis=1)[:, EXTREME_SHAPES - 1 : EXTREME_SHAPES]
    weights = _draw_active(rng, key <= bound, correlation=correlation)
    looking = np.flatnonzero(rng.random(size) < EXTREME_GAZE)
    weights[looking, rng.choice(EYE_LOOK_INDICES, len(looking))] = rng.random(len(looking))
    return np.where(weights > 0, EXTREME_FROM + (1 - EXTREME_FROM) * weights, 0.0)


def draw_divergent(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """A sparse face whose eyes do not look the same way.

    That its eyes look apart is drawn with the gaze.
    """
    return draw_sparse(rng, size, correlation=correlation)


def draw_upper_face(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """About a third of the shapes of brows, lids, nose and cheekSquint, and any gaze; all else rests."""
    return _draw_active(rng, _draw_share(rng, size) & _IS_UPPER, correlation=correlation)


def draw_lower_face(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """About a third of the shapes of jaw, mouth, cheekPuff and tongue; the eyes are open and look ahead."""
    return _draw_active(rng, _draw_share(rng, size) & ~_IS_UPPER, correlation=correlation)


def draw_combined(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """jawOpen above 0.35 with both eyes 0.3 to 0.8 closed, in a dense face: made to be withheld from training."""
    weights = draw_dense(rng, size, correlation=correlation)
    weights[:, _JAW] = COMBINED_JAW + (1 - COMBINED_JAW) * (1 - rng.random(size))
    least, most = COMBINED_BLINK
    weights[:, BLINK_INDICES] = least + (most - least) * draw_sides(rng, size, correlation=correlation)
    weights[:, _WIDES] = 0.0
    return weights


def draw_wink(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """One eye that shuts, or in a third of the faces both, half of them fully; all else rests."""
    strength = np.where(rng.random(size) < WINK_FULL, 1.0, rng.random(size))
    sides = np.where(rng.random(size) < WINK_BOTH, 2, rng.integers(0, 2, size))
    weights = np.zeros((size, len(BLENDSHAPES)))
    for side, column in enumerate(BLINK_INDICES):
        weights[:, column] = np.where((sides == side) | (sides == 2), strength, 0.0)
    return weights


def draw_tongue(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """A tongue out of an open mouth, half of them fully, or in a third of the faces the open mouth alone.

    About a seventh of the lower face's other shapes move beside it; the eyes rest. Networks that saw few tongues took
    an open mouth for one.
    """
    beside = (rng.random((size, len(_FIRST))) < TONGUE_OTHERS) & ~_IS_UPPER
    weights = _draw_active(rng, beside, correlation=correlation)
    out = np.where(rng.random(size) < TONGUE_FULL, 1.0, rng.random(size))
    weights[:, _TONGUE] = np.where(rng.random(size) < TONGUE_NONE, 0.0, out)
    weights[:, _JAW] = TONGUE_NEEDS_JAW + 0.01 + (0.99 - TONGUE_NEEDS_JAW) * rng.random(size)
    weights[:, CLOSING] = 0.0
    return weights


def _draw_share(rng: np.random.Generator, size: int) -> np.ndarray:
    return rng.random((size, len(_FIRST))) < REGION_SHARE


def _draw_active(rng: np.random.Generator, first: np.ndarray, *, correlation: float) -> np.ndarray:
    """Weights (n, 52) of the active shapes; ``first`` (n, len(_FIRST)) bool says which.

    A partner joins with a probability of the correlation, so that at 0 most shapes move on one side alone. Where
    the lips close or the tongue comes out, the jaw opens.
    """
    active = np.zeros((len(first), len(BLENDSHAPES)), bool)
    active[:, _FIRST] = first
    chosen = active[:, LEFT]
    joined = rng.random((len(first), 2))
    other_side = joined[:, :1] < 0.5
    both = joined[:, 1:] < correlation
    active[:, RIGHT] = chosen & (both | other_side)
    active[:, LEFT] = chosen & (both | ~other_side)
    active[:, _JAW] |= active[:, CLOSING] | active[:, _TONGUE]
    weights = np.where(active, draw_shapes(rng, len(first), correlation=correlation), 0.0)
    tongue = active[:, _TONGUE]
    weights[tongue, _JAW] = TONGUE_NEEDS_JAW + 0.01 + (0.99 - TONGUE_NEEDS_JAW) * weights[tongue, _JAW]
    return weights
