"""Draws faces by the expression model, version 1: a component for each, and what all faces share."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLINK_INDICES, EYE_LOOK_INDICES
from facegen.expression.acted import draw_lips
from facegen.expression.components import COMPONENTS, UNMIXED
from facegen.expression.couplings import CLOSE_BEYOND_JAW, close_lips, fade, follow_gaze, restrain
from facegen.expression.sides import draw_shapes
from facegen.expression.templates import CLOSING
from facegen.sampling.gaze import (
    AHEAD,
    axes_from_target,
    diverge,
    draw_deviation,
    draw_gaze_target,
    weights_from_axes,
)
from facegen.spec import Expression, Spec

FAINTEST = 0.02
"""Subtle faces are scaled by a factor from this to 1, every order of magnitude as often as the next."""

BLINK_SHUT = 0.5
"""Share of blinks in which the eyes are shut; the others are on their way."""


LIDS_FOLLOW_DOWN, LIDS_FOLLOW_UP = 0.8, 0.8
"""Largest share of eyeLookDown in eyeBlink, and of eyeLookUp in eyeWide; drawn anew for every face."""

_RESTLESS = np.ones(len(BLENDSHAPES))
_RESTLESS[EYE_LOOK_INDICES] = 0.0
_RESTLESS[[CLOSING, BLENDSHAPE_INDEX["tongueOut"]]] = 0.0
_RESTLESS[[BLENDSHAPE_INDEX[n] for n in ("jawOpen", "jawLeft", "jawRight", "mouthLeft", "mouthRight")]] = 0.3
_RESTLESS[[BLENDSHAPE_INDEX[n] for n in ("eyeWideLeft", "eyeWideRight")]] = 0.3
"""How much of the resting activity each shape has."""


@dataclass(frozen=True, kw_only=True, eq=False)
class DrawnFaces:
    """Expressions of n faces.

    Attributes
    ----------
    weights
        (n, 52) blendshape weights in [0, 1].
    gaze
        (n, 2, 3) unit optical axes in the head frame, subject's left eye first.
    component
        (n,) int8, index into `facegen.sampling.COMPONENT_NAMES`.
    """

    weights: np.ndarray
    gaze: np.ndarray
    component: np.ndarray


def draw_faces(
    spec: Spec, streams: Callable[[str], np.random.Generator], eye_center: np.ndarray
) -> DrawnFaces:
    """Expressions and gaze of n faces.

    Parameters
    ----------
    spec
        The spec.
    streams
        Gives the random stream of a part by its name, so that parts do not depend on each other's draws.
    eye_center
        (n, 2, 3) centres of the eyeballs, head frame, metres, subject's left eye first.
    """
    settings, size = spec.expression, len(eye_center)
    component = draw_components(settings, streams("expression"), size)
    weights = np.empty((size, len(BLENDSHAPES)))
    for index, (name, part) in enumerate(COMPONENTS.items()):
        rows = np.flatnonzero(component == index)
        if len(rows):
            rng = streams(f"expression {name}")
            weights[rows] = part.draw(rng, len(rows), correlation=settings.left_right_correlation)
    living, conjugate, looking, subtle = (
        np.array([getattr(part, trait) for part in COMPONENTS.values()])[component]
        for trait in ("living", "conjugate", "looking", "subtle")
    )
    alive = np.flatnonzero(living)
    weights[alive] = draw_lips(streams("expression lips"), weights[alive])
    rng = streams("expression rest")
    closing = weights[:, CLOSING].copy()
    weights *= np.where(subtle, draw_subtlety(settings, rng, size), 1.0)[:, None]
    weights[:, CLOSING] = closing
    weights = 1 - (1 - weights) * (1 - draw_resting(settings, rng, size) * living[:, None])
    weights[alive] = fade(weights[alive])
    # closed lips are mostly just closed: the fourth power keeps the median at 0.004 (0.002 in the range-of-motion take)
    close_lips(weights, beyond=CLOSE_BEYOND_JAW * rng.random(size) ** 4)
    blinks = draw_blinks(streams("expression blinks"), size, share=settings.blinks)
    weights[:, BLINK_INDICES] = np.maximum(weights[:, BLINK_INDICES], blinks[:, None])
    target = draw_gaze_target(spec, streams, size, wish=weights)
    gaze = axes_from_target(target, eye_center)
    apart = np.flatnonzero(~conjugate)
    gaze[apart] = diverge(gaze[apart], draw_deviation(streams("gaze apart"), len(apart)))
    gaze[~looking] = AHEAD
    for column, value in weights_from_axes(gaze).items():
        weights[:, column] = value
    down, up = rng.random((2, size)) * living
    follow_gaze(weights, down=LIDS_FOLLOW_DOWN * down, up=LIDS_FOLLOW_UP * up)
    return DrawnFaces(
        weights=restrain(weights), gaze=gaze, component=(component + len(UNMIXED)).astype(np.int8)
    )


def draw_components(settings: Expression, rng: np.random.Generator, size: int) -> np.ndarray:
    """Which of `COMPONENTS` (size,) makes each face, by the shares of ``[expression.mixture]``."""
    shares = np.array([getattr(settings.mixture, name) for name in COMPONENTS])
    edges = np.cumsum(shares)
    return np.searchsorted(edges, rng.random(size) * edges[-1], side="right")


def draw_subtlety(settings: Expression, rng: np.random.Generator, size: int) -> np.ndarray:
    """Factors (size,) on the weights: 1, or for subtle faces log-uniform from `FAINTEST` to 1."""
    chosen, unit = rng.random((2, size))
    return np.where(chosen < settings.subtle, FAINTEST**unit, 1.0)


def draw_resting(settings: Expression, rng: np.random.Generator, size: int) -> np.ndarray:
    """Activity (size, 52) that faces have at rest: mostly faint, at most ``settings.resting``."""
    unit = draw_shapes(rng, size, correlation=settings.left_right_correlation)
    return settings.resting * _RESTLESS * unit**2


def draw_blinks(rng: np.random.Generator, size: int, *, share: float) -> np.ndarray:
    """How far (size,) a blink has shut both eyes; 0 in all but ``share`` of the faces."""
    blinks, shut = rng.random((2, size))
    closing = rng.random(size)
    return np.where(blinks < share, np.where(shut < BLINK_SHUT, 1.0, closing), 0.0)
