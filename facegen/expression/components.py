"""Lists the components of the expression model; specs weight them, and labels name them."""

import inspect
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
    draw_tongue,
    draw_upper_face,
    draw_wink,
)
from facegen.expression.talking import draw_talk


@dataclass(frozen=True, kw_only=True)
class Component:
    """A part of the mixture.

    Attributes
    ----------
    draw
        ``draw(rng, size, correlation=...)`` gives weights (size, 52) with the closing in the column of mouthClose
        (see `templates`); eyeLook* weights are a wish where the eyes look. Its docstring's first paragraph says in
        docs/spec.md what the faces show.
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

    draw: Callable[..., np.ndarray]
    living: bool
    conjugate: bool = True
    looking: bool = True
    subtle: bool = True
    share: float = 0.0
    first: bool = False

    @property
    def meaning(self) -> str:
        """What its faces show."""
        return " ".join((inspect.getdoc(self.draw) or "").split("\n\n")[0].split())


COMPONENTS: dict[str, Component] = {
    "rest": Component(draw=draw_rest, living=True, share=0.04, first=True),
    "single": Component(draw=draw_single, living=False, share=0.10, first=True),
    "emotion": Component(draw=draw_emotion, living=True, share=0.10, first=True),
    "speech": Component(draw=draw_speech, living=True, share=0.30, first=True),
    "movement": Component(draw=draw_movement, living=True, share=0.30, first=True),
    "one_sided": Component(draw=draw_one_sided, living=True, share=0.05, first=True),
    "sparse": Component(draw=draw_sparse, living=False, share=0.05, first=True),
    "dense": Component(draw=draw_dense, living=False, share=0.02, first=True),
    "extreme": Component(draw=draw_extreme, living=False, share=0.03, first=True),
    "divergent": Component(draw=draw_divergent, living=False, conjugate=False, share=0.01, first=True),
    "upper_face": Component(draw=draw_upper_face, living=False),
    "lower_face": Component(draw=draw_lower_face, living=False, looking=False),
    "combined": Component(draw=draw_combined, living=False, subtle=False),
    "talk": Component(draw=draw_talk, living=True),
    "wink": Component(draw=draw_wink, living=False, subtle=False),
    "tongue": Component(draw=draw_tongue, living=False, looking=False, subtle=False),
}
"""Every component, by its key of ``[expression.mixture]``; a new one is a module and a line here."""

UNMIXED = ("neutral", "recording")
"""What ``component`` labels count before the mixture: faces without any expression, and frames of a recording."""
