"""Draws faces as in ordinary talk, with shapes that recorded faces show all the time and visemes leave out."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.expression.acted import draw_speech, together
from facegen.expression.sides import draw_sides, over_shapes
from facegen.expression.templates import CLOSING, columns

TEETH_TOGETHER = 0.35
"""Share of talking faces whose lips part over a shut jaw, as for s, z, f and between words."""
PARTED = (("mouthLowerDown", 0.6), ("mouthUpperUp", 0.35), ("mouthShrugUpper", 0.3))
"""How far such lips part at most."""
MEANWHILE = (
    *(("eyeSquint", 0.7, 0.45), ("cheekSquint", 0.3, 0.3)),
    *(("mouthStretch", 0.4, 0.45), ("mouthDimple", 0.4, 0.4), ("mouthFrown", 0.35, 0.5)),
    *(("mouthShrugLower", 0.3, 0.5), ("mouthPucker", 0.2, 0.4), ("mouthFunnel", 0.3, 0.35)),
)
"""Shapes, the share of talking faces that show them, and the most that they show: uniform from 0. Faces that talk or
perform before a phone have eyeSquint at .20 to .27 in the mean, and these shapes of the mouth at .15 to .25."""
ASIDE, ASIDE_MOST = 0.2, 0.4
"""Share of talking faces whose jaw stands to one side, and by how much at most; the mouth goes along."""

_JAW = BLENDSHAPE_INDEX["jawOpen"]


def draw_talk(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """Speech, with lips that part over a shut jaw, lids that squint a little, corners that dimple or stretch, and a
    jaw that goes to one side.
    """
    weights = draw_speech(rng, size, correlation=correlation)
    shut = rng.random(size) < TEETH_TOGETHER
    weights[shut, _JAW] = 0.06 * rng.random(int(shut.sum()))
    weights[shut, CLOSING] = 0.0
    _add(weights, PARTED, shut, rises=_draw_rises(rng, size, correlation=correlation))
    for shape, share, most in MEANWHILE:
        shown = rng.random(size) < share
        _add(weights, ((shape, most),), shown, rises=_draw_rises(rng, size, correlation=correlation))
    aside = np.where(rng.random(size) < ASIDE, ASIDE_MOST * rng.random(size), 0.0)
    follows = rng.random(size)
    left = rng.random(size) < 0.5
    for side, here in (("Left", left), ("Right", ~left)):
        weights[:, BLENDSHAPE_INDEX[f"jaw{side}"]] = np.where(here, aside, 0.0)
        mouth = BLENDSHAPE_INDEX[f"mouth{side}"]
        weights[:, mouth] = together(weights[:, mouth], np.where(here, aside * follows, 0.0))
    return weights


def _draw_rises(rng: np.random.Generator, size: int, *, correlation: float) -> np.ndarray:
    """How far shapes rise (size, 52), 0 to 1: equal but for their sides."""
    sides = over_shapes(draw_sides(rng, size, correlation=correlation))
    return np.broadcast_to(sides, (size, len(BLENDSHAPES)))


def _add(
    weights: np.ndarray, shapes: tuple[tuple[str, float], ...], where: np.ndarray, *, rises: np.ndarray
) -> None:
    """Add shapes that rise together, in place, where (n,) bool says so."""
    for shape, most in shapes:
        for column in columns(shape):
            rise = np.where(where, most * rises[:, column], 0.0)
            weights[:, column] = together(weights[:, column], rise)
