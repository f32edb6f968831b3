"""Draws faces that do what people do: rest, feel, speak, move on purpose, on both sides or on one."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.expression.sides import draw_shapes, draw_sides, over_shapes
from facegen.expression.templates import CLOSING, Templates, columns, load_emotions, load_templates

SOMETIMES = 0.4
"""Chance of an action unit that some people show with an emotion (20 to 67 % in the table's source)."""
UNEVEN = (0.3, 1.7)
"""Factors between which each weight of a template varies from face to face."""
SPEECH_EMOTION, SPEECH_EYES, SPEECH_CLOSED = 0.3, 0.6, 0.25
"""Shares of speaking faces that feel something, whose brows or lids move, and whose lips are just closed."""
MOVEMENTS_TWO, MOVEMENTS_EYES, MOVEMENTS_EYES_ONLY = 0.4, 0.6, 0.2
"""Shares of voluntary movements that join two of the mouth's, that move brows or lids, and that move these only."""
MOVEMENTS_SEAL = 0.2
"""Share of them that are the lips' closing over a dropped jaw: 8 % of frames of the range-of-motion take have it
(mouthClose above 0.15, half of jawOpen or more), and networks that had not seen it learnt mouthClose with the wrong
sign."""
OTHER_SIDE = 0.25
"""Strongest that the weaker side of a one-sided face is, as a share of the stronger one."""
LIPS_FOLLOW = (("mouthLowerDown", 0.9), ("mouthStretch", 0.6))
"""Shapes that rise with what jawOpen leaves open, and the most that they rise per unit of it."""
LIPS_APART = (("mouthShrugUpper", 0.45), ("mouthUpperUp", 0.25))
"""Shapes that rise together, by no more than this, as soon as the lips part."""
LIPS_TOGETHER = (
    *(("mouthShrugLower", 0.6), ("mouthPress", 0.3), ("mouthRollLower", 0.25)),
    *(("mouthDimple", 0.25), ("cheekPuff", 0.15)),
)
"""Shapes that rise together, by no more than this, while the lips are held closed."""
APART = 0.1
"""Share of jawOpen left open at which lips are wholly apart."""

_JAW = BLENDSHAPE_INDEX["jawOpen"]


def draw_rest(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """A resting face: little but ``resting`` activity.

    Closed lips over a jaw that hangs a little; resting activity comes on top of it.
    """
    weights = np.zeros((size, len(BLENDSHAPES)))
    weights[:, _JAW] = 0.3 * rng.random(size) ** 3
    weights[:, CLOSING] = 1.0
    return weights


def draw_emotion(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """One of 23 emotions as FACS action units, from faint to full."""
    table = load_emotions()
    kind = rng.integers(0, len(table.names), size)
    chance = np.where(table.always, 1.0, np.where(table.sometimes, SOMETIMES, 0.0))
    shown = rng.random((size, len(table.units))) < chance[kind]
    strength = np.where(shown, 0.4 + 0.6 * rng.random(shown.shape), 0.0)
    # units that share a shape add up; einsum sums in one order on every machine, a BLAS product does not
    full = np.minimum(np.einsum("nu,us->ns", strength, table.units.weights), 1.0)
    # the unit that parts the lips most decides
    full[:, CLOSING] = np.where(shown, table.units.weights[:, CLOSING], 1.0).min(axis=1)
    sides = draw_sides(rng, size, correlation=correlation)
    return draw_uneven(rng, full, sides, correlation=correlation)


def draw_speech(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """Between two of 15 visemes, with what brows, lids and feelings do meanwhile."""
    visemes = load_templates("visemes").weights
    first, second = rng.integers(0, len(visemes), (2, size))
    share = rng.random((size, 1))
    blend = (1 - share) * visemes[first] + share * visemes[second]
    # loudness moves the jaw more than the lips: drawn apart
    sides = 1.5 * draw_sides(rng, size, correlation=correlation)
    weights = draw_uneven(rng, blend, sides, correlation=correlation)
    weights[:, _JAW] = np.minimum(blend[:, _JAW] * 1.6 * rng.random(size), 1.0)
    closed = rng.random(size) < SPEECH_CLOSED
    weights[closed, CLOSING] = 1.0
    feels = np.flatnonzero(rng.random(size) < SPEECH_EMOTION)
    emotion = 0.6 * draw_emotion(rng, len(feels), correlation=correlation)
    emotion[:, (CLOSING, _JAW)] = 0.0
    weights[feels] = together(weights[feels], emotion)
    return _draw_eyes_too(rng, weights, rng.random(size) < SPEECH_EYES, correlation=correlation)


def draw_movement(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """Voluntary movements of mouth, jaw, cheeks, brows and lids, as in range-of-motion takes."""
    mouth = load_templates("mouth")
    kind = rng.integers(0, len(mouth), size)
    kind[rng.random(size) < MOVEMENTS_SEAL] = mouth.names.index("seal")
    weights = _draw_performed(rng, mouth.weights[kind], correlation=correlation)
    second = np.flatnonzero(rng.random(size) < MOVEMENTS_TWO)
    kind = rng.integers(0, len(mouth), len(second))
    more = 0.7 * _draw_performed(rng, mouth.weights[kind], correlation=correlation)
    more[:, CLOSING] = 0.0
    weights[second] = together(weights[second], more)
    what = rng.random(size)
    weights[what < MOVEMENTS_EYES_ONLY] = np.arange(len(BLENDSHAPES)) == CLOSING
    return _draw_eyes_too(rng, weights, what < MOVEMENTS_EYES, correlation=correlation)


def draw_one_sided(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """Winks, smirks and every other movement on one side.

    The other side follows a little or not.
    """
    mouth, eyes = load_templates("mouth"), load_templates("eyes")
    every = Templates(names=mouth.names + eyes.names, weights=np.concatenate([mouth.weights, eyes.weights]))
    kind = rng.integers(0, len(every), size)
    kind[rng.random(size) < 0.3] = every.names.index("wink")
    strong = rng.random(size)
    weak = strong * np.maximum(rng.random(size) * 2 * OTHER_SIDE - OTHER_SIDE, 0.0)
    left = rng.random(size) < 0.5
    sides = np.stack([np.where(left, strong, weak), np.where(left, weak, strong)], axis=-1)
    return draw_uneven(rng, every.weights[kind], sides, correlation=correlation)


def draw_uneven(
    rng: np.random.Generator, full: np.ndarray, sides: np.ndarray, *, correlation: float
) -> np.ndarray:
    """Weights (n, 52) of templates (n, 52) at strengths (n, 2) left and right, each a little off its template."""
    low, high = UNEVEN
    factor = low + (high - low) * draw_shapes(rng, len(full), correlation=correlation)
    weights = np.minimum(full * over_shapes(sides) * factor, 1.0)
    # how far the lips close over the jaw is no matter of strength; closed lips are closed three times in four
    weights[:, CLOSING] = np.minimum(full[:, CLOSING] * (0.8 + 0.8 * rng.random(len(full))), 1.0)
    return weights


def draw_lips(rng: np.random.Generator, weights: np.ndarray) -> np.ndarray:
    """Weights (n, 52) whose lips go with the jaw as they do in people; each face has its own shares.

    In the range-of-motion take mouthStretch and mouthLowerDown rise with jawOpen (r = 0.88, 0.79), mouthShrugUpper
    doubles as soon as the lips part, and mouthShrugLower, mouthPress, mouthRollLower and mouthDimple go together
    (r = 0.5 to 0.9) and only while lips are closed. The orders of magnitude of these tables are such statistics.
    """
    opening = weights[:, _JAW] * (1 - weights[:, CLOSING])
    apart = np.minimum(opening / APART, 1.0)
    unit = rng.random((4, len(weights)))
    rises = (
        *(
            (shape, most * share * opening)
            for (shape, most), share in zip(LIPS_FOLLOW, unit[:2], strict=True)
        ),
        *((shape, most * unit[2] * apart) for shape, most in LIPS_APART),
        *((shape, most * unit[3] ** 2 * (1 - apart)) for shape, most in LIPS_TOGETHER),
    )
    weights = weights.copy()
    for shape, rise in rises:
        for column in columns(shape):
            weights[:, column] = together(weights[:, column], rise)
    return weights


def together(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Both at once, never above 1: ``1 - (1 - a) (1 - b)``."""
    return 1 - (1 - first) * (1 - second)


def _draw_performed(rng: np.random.Generator, full: np.ndarray, *, correlation: float) -> np.ndarray:
    sides = draw_sides(rng, len(full), correlation=correlation)
    return draw_uneven(rng, full, sides, correlation=correlation)


def _draw_eyes_too(
    rng: np.random.Generator, weights: np.ndarray, where: np.ndarray, *, correlation: float
) -> np.ndarray:
    """Weights (n, 52) with a movement of brows or lids added where (n,) bool says so; in place."""
    rows = np.flatnonzero(where)
    table = load_templates("eyes").weights
    eyes = _draw_performed(rng, table[rng.integers(0, len(table), len(rows))], correlation=correlation)
    eyes[:, CLOSING] = 0.0
    weights[rows] = together(weights[rows], eyes)
    return weights
