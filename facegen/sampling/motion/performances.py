"""Draws performances: one expression, speech, a walk through all movements, a conversation.

Courses here hold the *closing* in the column of mouthClose (see `facegen.expression.templates`).
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.expression.acted import SOMETIMES, draw_emotion, draw_lips, draw_uneven, together
from facegen.expression.couplings import TONGUE_NEEDS_JAW
from facegen.expression.sides import draw_sides
from facegen.expression.templates import CLOSING, Templates, load_emotions, load_templates
from facegen.sampling.motion.continuity import TONGUE_OUT_WITHIN
from facegen.sampling.motion.envelopes import blend, draw_edges, memberships, wander
from facegen.sampling.motion.speech import draw_utterance, draw_visemes, speech_course

ONSET_S, OFFSET_S = (0.3, 0.6), (0.4, 0.8)
"""How long posed expressions take to appear and to go; they fade more slowly (Hess & Kleck 1990, Eur. J. Soc. Psychol.
20). Whole macro-expressions last 0.5 to 4 s (Ekman 2003, "Emotions Revealed")."""
APEX_S = (0.8, 3.0)
BEFORE_S, AFTER_S = (0.1, 0.35), (0.1, 0.3)
"""Rest before the onset and after the offset."""
STRONG, HELD = (0.75, 1.0), (0.8, 1.0)
"""Strength of peak expressions, and what is left of it at the end of the apex."""
RANGE_GAP_S, RANGE_PASSAGE_S, RANGE_REST = (0.4, 1.0), (0.2, 0.5), 0.4
"""Range of motion: seconds a movement, its passages, and the share followed by rest. A recorded range-of-motion take
moves by up to 8 to 12 a second: the whole way takes 0.16 to 0.23 s there."""
REACTION_GAP_S, REACTION_PASSAGE_S, REACTIONS = (0.8, 2.5), 0.6, 0.5
"""What brows, lids and feelings do meanwhile: seconds a reaction, the longest passage, and how often there is one."""
LEAD_S, TAIL_S = (0.3, 0.7), (0.4, 0.8)
"""Silence before and after a sentence."""
TALK_S, LISTEN_S = (2.0, 8.0), (1.0, 4.0)
"""Turns of a conversation."""
ONE_SIDED = (("eyes", "wink"), ("mouth", "smile"), ("eyes", "outer_raise"))
"""Peak expressions that each side shows alone."""

_JAW, _TONGUE = BLENDSHAPE_INDEX["jawOpen"], BLENDSHAPE_INDEX["tongueOut"]
_REST = np.zeros(len(BLENDSHAPES))
_REST[CLOSING] = 1.0
_NOTHING = -1


@dataclass(frozen=True, kw_only=True)
class Direction:
    """What a performance is told: number of the clip in its kind, left-right ``correlation``, ``syllables_per_s``."""

    index: int
    correlation: float
    syllables_per_s: float


@cache
def peak_expressions() -> tuple[tuple[str, str, str], ...]:
    """The 73 peak expressions as (family, name, side): emotions, every movement, some on one side, a stretched face."""
    mouth, eyes = load_templates("mouth").names, load_templates("eyes").names
    both = [("emotion", name, "both") for name in load_emotions().names]
    both += [("mouth", name, "both") for name in mouth]
    both += [("eyes", name, "both") for name in eyes if name != "wink"]
    one = [(family, name, side) for family, name in ONE_SIDED for side in ("left", "right")]
    return (*both, *one, ("all", "stretch", "both"))


def draw_peak(rng: np.random.Generator, time_s: np.ndarray, direction: Direction) -> np.ndarray:
    """Rest, onset, apex, offset, rest: weights (n, 52) of one of `peak_expressions`."""
    pose = _draw_peak_pose(rng, direction)
    onset, offset, apex, before, after = (
        low + (high - low) * rng.random() for low, high in (ONSET_S, OFFSET_S, APEX_S, BEFORE_S, AFTER_S)
    )
    duration = time_s[-1] - time_s[0]
    rise = before + onset / 2
    fall = min(rise + onset / 2 + apex + offset / 2, duration - after - offset / 2)
    held = _scaled(pose, HELD[0] + (HELD[1] - HELD[0]) * rng.random())
    edges = np.array([rise, (rise + fall) / 2, fall])
    width = np.array([onset, max(fall - rise - (onset + offset) / 2, onset), offset])
    return blend(memberships(time_s, edges, width), np.stack([_REST, pose, held, _REST]))


def draw_sentence(rng: np.random.Generator, time_s: np.ndarray, direction: Direction) -> np.ndarray:
    """A sentence: weights (n, 52)."""
    lead, tail = (low + (high - low) * rng.random() for low, high in (LEAD_S, TAIL_S))
    return _draw_talk(rng, time_s, [(lead, time_s[-1] - tail)], direction)


def draw_conversation(rng: np.random.Generator, time_s: np.ndarray, direction: Direction) -> np.ndarray:
    """Turns of talking and listening: weights (n, 52)."""
    spans, now = [], LISTEN_S[0] * rng.random()
    while now < time_s[-1]:
        talk, listen = (low + (high - low) * rng.random() for low, high in (TALK_S, LISTEN_S))
        spans.append((now, min(now + talk, time_s[-1])))
        now += talk + listen
    return _draw_talk(rng, time_s, spans, direction)


def draw_mouth_range(rng: np.random.Generator, time_s: np.ndarray, direction: Direction) -> np.ndarray:
    """All movements of mouth, jaw and cheeks one after the other: weights (n, 52)."""
    return _draw_range(rng, time_s, load_templates("mouth"), direction)


def draw_eye_range(rng: np.random.Generator, time_s: np.ndarray, direction: Direction) -> np.ndarray:
    """All movements of brows, lids and nose one after the other: weights (n, 52)."""
    return _draw_range(rng, time_s, load_templates("eyes"), direction)


def _draw_peak_pose(rng: np.random.Generator, direction: Direction) -> np.ndarray:
    peaks = peak_expressions()
    family, name, side = peaks[direction.index % len(peaks)]
    if family == "emotion":
        table = load_emotions()
        kind = table.names.index(name)
        shown = table.always[kind] | (table.sometimes[kind] & (rng.random(len(table.units)) < SOMETIMES))
        units = table.units.weights[shown]
        full = np.minimum(units.sum(axis=0), 1.0)
        full[CLOSING] = units[:, CLOSING].min()
    elif family == "all":
        full = together(_template("mouth", "jaw_drop"), _template("eyes", "wide"))
        full[CLOSING] = 0.0
    else:
        full = _template(family, name)
    strength = STRONG[0] + (STRONG[1] - STRONG[0]) * draw_sides(rng, 1, correlation=direction.correlation)
    if side != "both":
        strength[:, 1 if side == "left" else 0] *= 0.1
    return _draw_poses(rng, full[None], strength, direction)[0]


def _draw_range(
    rng: np.random.Generator, time_s: np.ndarray, family: Templates, direction: Direction
) -> np.ndarray:
    edges = draw_edges(rng, time_s[-1], RANGE_GAP_S)
    order = [_NOTHING]
    while len(order) <= len(edges):
        for movement in rng.permutation(len(family)):
            order += [movement, _NOTHING] if rng.random() < RANGE_REST else [movement]
    shown = np.array(order[: len(edges) + 1])
    strength = 0.6 + 0.4 * draw_sides(rng, len(shown), correlation=direction.correlation)
    poses = _draw_poses(rng, family.weights[shown], strength, direction)
    poses[shown == _NOTHING] = _REST
    low, high = RANGE_PASSAGE_S
    return wander(time_s, edges, poses, low + (high - low) * rng.random(len(edges)))


def _draw_poses(
    rng: np.random.Generator, full: np.ndarray, sides: np.ndarray, direction: Direction
) -> np.ndarray:
    """Poses (k, 52) of templates (k, 52) as people show them; a jaw that lets the tongue out opens far enough."""
    poses = draw_lips(rng, draw_uneven(rng, full, sides, correlation=direction.correlation))
    out = full[:, _TONGUE] > 0
    poses[out, _JAW] = np.maximum(poses[out, _JAW], TONGUE_NEEDS_JAW + TONGUE_OUT_WITHIN)
    return poses


def _draw_talk(
    rng: np.random.Generator, time_s: np.ndarray, spans_s: list[tuple[float, float]], direction: Direction
) -> np.ndarray:
    visemes = draw_visemes(rng, correlation=direction.correlation)
    utterance = draw_utterance(rng, spans_s, syllables_per_s=direction.syllables_per_s)
    return together(speech_course(utterance, visemes, time_s), _draw_reactions(rng, time_s, direction))


def _draw_reactions(rng: np.random.Generator, time_s: np.ndarray, direction: Direction) -> np.ndarray:
    """Feelings and movements of brows and lids now and then; neither jaw nor closing."""
    edges = draw_edges(rng, time_s[-1], REACTION_GAP_S)
    size = len(edges) + 1
    table = load_templates("eyes").weights
    sides = draw_sides(rng, size, correlation=direction.correlation)
    poses = draw_uneven(
        rng, table[rng.integers(0, len(table), size)], sides, correlation=direction.correlation
    )
    feels = rng.random(size) < 0.5
    poses[feels] = 0.6 * draw_emotion(rng, size, correlation=direction.correlation)[feels]
    poses[rng.random(size) >= REACTIONS] = 0.0
    poses[0] = 0.0
    poses[:, (CLOSING, _JAW)] = 0.0
    return wander(time_s, edges, poses, REACTION_PASSAGE_S)


def _template(family: str, name: str) -> np.ndarray:
    templates = load_templates(family)
    return templates.weights[templates.names.index(name)].copy()


def _scaled(pose: np.ndarray, share: float) -> np.ndarray:
    """A pose (52,) made weaker; how far its lips close stays."""
    weaker = pose * share
    weaker[CLOSING] = pose[CLOSING]
    return weaker
