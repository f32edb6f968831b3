"""Lists the kinds of clips: what is done in each, where the person looks, how much the head moves meanwhile."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES
from facegen.sampling.motion.glances import DrawFixations, draw_glances, draw_sweep
from facegen.sampling.motion.performances import (
    Direction,
    draw_conversation,
    draw_eye_range,
    draw_mouth_range,
    draw_peak,
    draw_sentence,
)

Draw = Callable[[np.random.Generator, np.ndarray, Direction], np.ndarray]


@dataclass(frozen=True, kw_only=True)
class ClipKind:
    """A kind of clip.

    Attributes
    ----------
    draw
        Weights (n, 52) of times (n,), with the closing in the column of mouthClose; clip i takes entry i modulo their
        number.
    look
        Where the person looks; likewise.
    blinks_per_min
        Of the average person: 17 at rest, 26 in conversation (Bentivoglio et al. 1997, Movement Disorders 12).
    head_gap_s, head_share
        Seconds between turns of the head, and their size as a share of the spread that the spec's ``[head]`` gives.
    neutral
        Whether the face does nothing at all; such frames are labelled neutral.
    """

    draw: tuple[Draw, ...]
    look: tuple[DrawFixations, ...] = (draw_glances,)
    blinks_per_min: float = 17.0
    head_gap_s: tuple[float, float] = (0.8, 2.5)
    head_share: float = 0.3
    neutral: bool = False


def _draw_nothing(_rng: np.random.Generator, time_s: np.ndarray, _direction: Direction) -> np.ndarray:
    return np.zeros((len(time_s), len(BLENDSHAPES)))


CLIP_KINDS: dict[str, ClipKind] = {
    "neutral": ClipKind(draw=(_draw_nothing,), head_share=0.1, neutral=True),
    "peak": ClipKind(draw=(draw_peak,), head_share=0.15),
    "sentence": ClipKind(draw=(draw_sentence,), head_gap_s=(0.4, 1.5)),
    "range_of_motion": ClipKind(
        draw=(draw_mouth_range, draw_eye_range), look=(draw_glances, draw_sweep), head_share=0.15
    ),
    "conversation": ClipKind(
        draw=(draw_conversation,), blinks_per_min=26.0, head_gap_s=(0.5, 2.0), head_share=0.5
    ),
}
"""Every kind of clip, in the order in which a session records them; its name is a key of ``[sequence]``."""
