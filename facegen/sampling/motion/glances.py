"""Glances: fixations, and the saccades between them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from facegen.sampling.motion.envelopes import blend, memberships, passages
from facegen.spec import Gaze, draw

SACCADE_S, SACCADE_S_PER_DEG = 0.021, 0.0022
"""The main sequence: a saccade takes 21 ms and 2.2 ms a degree (Carpenter 1988, "Movements of the Eyes")."""
VERGENCE_S = 0.3
"""How long eyes take to converge on another distance (0.2 to 0.4 s; Hung et al. 1994, IEEE Trans. Biomed. Eng. 41)."""
FIXATION_S, FIXATION_SPREAD, FIXATION_WITHIN_S = 0.6, 0.8, (0.15, 4.0)
"""Median, log standard deviation and bounds of fixations: 0.3 s on scenes (Rayner 1998, Psychological Bulletin 124),
seconds on a partner's face (Argyle & Cook 1976, "Gaze and Mutual Gaze")."""
AHEAD, AHEAD_SPREAD, AHEAD_DEG = 0.6, 0.3, 1.5
"""Share of fixations that come back to what the person talks to or is told to look at, how far from straight ahead that
lies as a share of the spec's spread, and the scatter of these fixations."""
SWEEP_S = (0.8, 1.2)
"""Fixations of people who are asked to look into every corner."""
SWEEP_DISTANCE_M = 10.0
_CORNERS = np.array([(0, 0), (-1, 0), (1, 0), (0, 1), (0, -1), (-1, 1), (1, 1), (-1, -1), (1, -1)], float)


@dataclass(frozen=True, kw_only=True, eq=False)
class Fixations:
    """k + 1 fixations: ``edges_s`` (k,) between them, ``yaw_deg``, ``pitch_deg`` and ``distance_m`` (k + 1,)."""

    edges_s: np.ndarray
    yaw_deg: np.ndarray
    pitch_deg: np.ndarray
    distance_m: np.ndarray


def draw_glances(rng: np.random.Generator, gaze: Gaze, duration_s: float) -> Fixations:
    """Fixations as the spec's ``[gaze]`` spreads them, most of them on one point."""
    low, high = FIXATION_WITHIN_S
    most = int(duration_s / low) + 1
    lasting = np.clip(FIXATION_S * np.exp(FIXATION_SPREAD * rng.standard_normal(most)), low, high)
    edges = np.cumsum(lasting)
    edges = edges[edges < duration_s]
    size = len(edges) + 1
    yaw, pitch, distance = (draw(d, rng, size) for d in (gaze.yaw_deg, gaze.pitch_deg, gaze.distance_m))
    ahead = rng.random(size) < AHEAD
    scatter = np.clip(rng.standard_normal((2, size)), -2, 2) * AHEAD_DEG
    return Fixations(
        edges_s=edges,
        yaw_deg=np.where(ahead, AHEAD_SPREAD * yaw[0] + scatter[0], yaw),
        pitch_deg=np.where(ahead, AHEAD_SPREAD * pitch[0] + scatter[1], pitch),
        distance_m=np.where(ahead, distance[0], distance),
    )


def draw_sweep(rng: np.random.Generator, gaze: Gaze, duration_s: float) -> Fixations:
    """Ahead, then into every corner of the spec's ``[gaze]`` in an order of its own, again and again."""
    low, high = SWEEP_S
    most = int(duration_s / low) + 1
    edges = np.cumsum(low + (high - low) * rng.random(most))
    edges = edges[edges < duration_s]
    rounds = -(-(len(edges) + 1) // len(_CORNERS))
    order = np.concatenate([[0, *(1 + rng.permutation(len(_CORNERS) - 1))] for _ in range(rounds)])
    corner = _CORNERS[order[: len(edges) + 1]]

    def reach(share: np.ndarray, low: float, high: float) -> np.ndarray:
        return np.where(share < 0, -share * min(low, 0.0), share * max(high, 0.0))

    return Fixations(
        edges_s=edges,
        yaw_deg=reach(corner[:, 0], gaze.yaw_deg.low, gaze.yaw_deg.high),
        pitch_deg=reach(corner[:, 1], gaze.pitch_deg.low, gaze.pitch_deg.high),
        distance_m=np.full(len(corner), SWEEP_DISTANCE_M),
    )


def saccade_seconds(amplitude_deg: np.ndarray) -> np.ndarray:
    """How long saccades of amplitudes (...) take, by the main sequence."""
    return SACCADE_S + SACCADE_S_PER_DEG * amplitude_deg


def gaze_course(fixations: Fixations, time_s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """``(yaw_deg, pitch_deg, distance_m)``, each (n,), of the point that is looked at, seen from between the eyes."""
    keys = np.stack([fixations.yaw_deg, fixations.pitch_deg], axis=-1)
    took = saccade_seconds(np.linalg.norm(np.diff(keys, axis=0), axis=-1))
    yaw, pitch = blend(memberships(time_s, fixations.edges_s, took), keys).T
    # eyes turn by the inverse of the distance
    nearness = 1.0 / fixations.distance_m[:, None]
    width = passages(fixations.edges_s, VERGENCE_S)
    return yaw, pitch, 1.0 / blend(memberships(time_s, fixations.edges_s, width), nearness)[:, 0]


DrawFixations = Callable[[np.random.Generator, Gaze, float], Fixations]
