"""The parts of the expression model by name, as specs weight them and labels name them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from facegen.sampling.expression.acted import (
    draw_emotion,
    draw_movement,
    draw_one_sided,
    draw_rest,
    draw_speech,
)
from facegen.sampling.expression.shapes import (
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
    """

    draw: Callable[..., np.ndarray]
    living: bool
    conjugate: bool = True
    looking: bool = True
    subtle: bool = True


COMPONENTS: dict[str, Component] = {
    "rest": Component(draw=draw_rest, living=True),
    "single": Component(draw=draw_single, living=False),
    "emotion": Component(draw=draw_emotion, living=True),
    "speech": Component(draw=draw_speech, living=True),
    "movement": Component(draw=draw_movement, living=True),
    "one_sided": Component(draw=draw_one_sided, living=True),
    "sparse": Component(draw=draw_sparse, living=False),
    "dense": Component(draw=draw_dense, living=False),
    "extreme": Component(draw=draw_extreme, living=False),
    "divergent": Component(draw=draw_divergent, living=False, conjugate=False),
    "upper_face": Component(draw=draw_upper_face, living=False),
    "lower_face": Component(draw=draw_lower_face, living=False, looking=False),
    "combined": Component(draw=draw_combined, living=False, subtle=False),
}
"""Every component; its name is a key of ``[expression.mixture]``, and what each shows is said there."""

COMPONENT_NAMES: tuple[str, ...] = ("neutral", "recording", *COMPONENTS)
"""What ``component`` labels count: calibration faces without any expression, frames of a recording, the mixture."""
