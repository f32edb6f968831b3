"""Draws blinks: their times, speeds and depths."""

from dataclasses import dataclass

import numpy as np

from facegen.sampling.motion.envelopes import smooth_step

CLOSING_S, OPENING_S = (0.075, 0.100), (0.150, 0.250)
"""How long lids take to close and to open (VanderWerf et al. 2003, "Eyelid movements", J. Neurophysiology 89;
Evinger et al. 1991, Exp. Brain Research 98: closing is two to three times as fast)."""
CLOSED_S = (0.015, 0.050)
"""How long they stay closed."""
FULL, PARTIAL = 0.85, (0.5, 0.9)
"""Share of blinks that close the eyes wholly, and the depths of the others."""
SHORTEST_GAP_S = 0.6
"""From the beginning of one blink to the next, at least: a blink lasts 0.4 s at most."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Blinks:
    """k blinks of both eyes: ``start_s``, ``closing_s``, ``closed_s``, ``opening_s``, ``depth`` (0 to 1); all (k,)."""

    start_s: np.ndarray
    closing_s: np.ndarray
    closed_s: np.ndarray
    opening_s: np.ndarray
    depth: np.ndarray


def draw_blinks(rng: np.random.Generator, duration_s: float, *, rate_per_min: float) -> Blinks:
    """Blinks that begin within a clip: a shortest gap and an exponential rest between any two."""
    mean_s = 60.0 / rate_per_min
    most = int(duration_s / SHORTEST_GAP_S) + 2
    rest = (mean_s - SHORTEST_GAP_S) * rng.exponential(size=most)
    # a clip begins anywhere, and so rather within a long gap: what is left of that is its exponential part, and with
    # the shortest gap's share of the mean one some of the shortest gap as well (the renewal process's residual life)
    unit, place = rng.random(2)
    rest[0] += SHORTEST_GAP_S * place * (unit < SHORTEST_GAP_S / mean_s)
    start = np.cumsum(rest + SHORTEST_GAP_S * (np.arange(most) > 0))
    unit = rng.random((5, most))
    closing, opening, closed = (
        low + (high - low) * u
        for (low, high), u in zip((CLOSING_S, OPENING_S, CLOSED_S), unit[:3], strict=True)
    )
    low, high = PARTIAL
    depth = np.where(unit[3] < FULL, 1.0, low + (high - low) * unit[4])
    within = start < duration_s
    return Blinks(
        start_s=start[within],
        closing_s=closing[within],
        closed_s=closed[within],
        opening_s=opening[within],
        depth=depth[within],
    )


def lid_closure(blinks: Blinks, time_s: np.ndarray) -> np.ndarray:
    """How far blinks close the lids (n,) at times (n,): 0 to 1."""
    since = time_s[:, None] - blinks.start_s
    closed = smooth_step(since / blinks.closing_s)
    opened = smooth_step((since - blinks.closing_s - blinks.closed_s) / blinks.opening_s)
    return (blinks.depth * (closed - opened)).sum(axis=1)
