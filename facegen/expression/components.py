"""Lists the components of the expression model; specs weight them, and labels name them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from facegen.expression.acted import (
    draw_emotion,
    draw_movement,
    draw_one_sided,
    draw_rest,
    draw_speech,
)
from facegen.expression.shapes import (
    draw_combined,
    draw_dense,
    draw_divergent,
    draw_extreme,
    draw_lower_face,
    draw_single,
    draw_sparse,
    draw_upper_face,
)


@dataclass(frozen=True, kw_only=True)
class Component:
    """A part of the mixture.

    Attributes
    ----------
    meaning
        What its faces show, for docs/spec.md.
    draw
        ``draw(rng, size, correlation=...)`` gives weights (size, 52) with the closing in the column of mouthClose
        (see `templates`); eyeLook* weights are a wish where the eyes look.
    living
        Whether resting activity and lids that follow the gaze come on top, as in people; faces of blind combinations
        stay as drawn.
    conjugate
        Whether both eyes look at one point.
    looking
        Whether the eyes look around; otherwise straight ahead, as in neutral faces.
    subtle
        Whether a share of the faces is scaled down; what must be strong is not.
    share
        Weight in the mixture of a spec that names none.
    first
        Whether the first datasets had it: then it is in a spec's hash where its weight is 0 too. A new one is not, and
        changes no dataset that does without.
    """

    meaning: str
    draw: Callable[..., np.ndarray]
    living: bool
    conjugate: bool = True
    looking: bool = True
    subtle: bool = True
    share: float = 0.0
    first: bool = False


COMPONENTS: dict[str, Component] = {
    "rest": Component(
        meaning="A resting face: little but ``resting`` activity.",
        draw=draw_rest,
        living=True,
        share=0.04,
        first=True,
    ),
    "single": Component(
        meaning="One shape, or a pair, through its whole range; mouthClose and tongueOut bring the jaw along.",
        draw=draw_single,
        living=False,
        share=0.10,
        first=True,
    ),
    "emotion": Component(
        meaning="One of 23 emotions as FACS action units, from faint to full.",
        draw=draw_emotion,
        living=True,
        share=0.10,
        first=True,
    ),
    "speech": Component(
        meaning="Between two of 15 visemes, with what brows, lids and feelings do meanwhile.",
        draw=draw_speech,
        living=True,
        share=0.30,
        first=True,
    ),
    "movement": Component(
        meaning="Voluntary movements of mouth, jaw, cheeks, brows and lids, as in range-of-motion takes.",
        draw=draw_movement,
        living=True,
        share=0.30,
        first=True,
    ),
    "one_sided": Component(
        meaning="Winks, smirks and every other movement on one side.",
        draw=draw_one_sided,
        living=True,
        share=0.05,
        first=True,
    ),
    "sparse": Component(
        meaning="One to six shapes, independent of each other, through their whole range.",
        draw=draw_sparse,
        living=False,
        share=0.05,
        first=True,
    ),
    "dense": Component(
        meaning="About a third of all shapes, independent of each other, up to 0.7.",
        draw=draw_dense,
        living=False,
        share=0.02,
        first=True,
    ),
    "extreme": Component(
        meaning="Three shapes at 0.75 or more, the eyes turned as far now and then.",
        draw=draw_extreme,
        living=False,
        share=0.03,
        first=True,
    ),
    "divergent": Component(
        meaning="A sparse face whose eyes do not look the same way.",
        draw=draw_divergent,
        living=False,
        conjugate=False,
        share=0.01,
        first=True,
    ),
    "upper_face": Component(
        meaning="About a third of the shapes of brows, lids, nose and cheekSquint, and any gaze; all else rests.",
        draw=draw_upper_face,
        living=False,
    ),
    "lower_face": Component(
        meaning="About a third of the shapes of jaw, mouth, cheekPuff and tongue; the eyes are open and look ahead.",
        draw=draw_lower_face,
        living=False,
        looking=False,
    ),
    "combined": Component(
        meaning="jawOpen above 0.35 with both eyes 0.3 to 0.8 closed, in a dense face: made to be withheld from "
        "training.",
        draw=draw_combined,
        living=False,
        subtle=False,
    ),
}
"""Every component, by its key of ``[expression.mixture]``; a new one is a module and a line here."""

UNMIXED = ("neutral", "recording")
"""What ``component`` labels count before the mixture: faces without any expression, and frames of a recording."""
