"""Smooth changes: from one value to the next without a jump of position, velocity or acceleration."""

import numpy as np


def smooth_step(share: np.ndarray) -> np.ndarray:
    """From 0 to 1 as its argument goes from 0 to 1: the minimum-jerk course of voluntary movements.

    Flash & Hogan 1985, "The coordination of arm movements", J. Neuroscience 5(7), eq. 1; lids and faces come close.
    """
    x = np.clip(share, 0.0, 1.0)
    return x**3 * (10 + x * (6 * x - 15))


def memberships(time_s: np.ndarray, edges_s: np.ndarray, width_s: np.ndarray | float) -> np.ndarray:
    """How much of each of k + 1 segments there is at each time: between 0 and 1, adding up to 1.

    Parameters
    ----------
    time_s
        (n,) times, seconds.
    edges_s
        (k,) ascending times at which one segment passes into the next.
    width_s
        (k,) or one number: how long each passage takes, half of it on either side of the edge. Where passages overlap,
        short segments are not reached whole: so do lips in fast speech.

    Returns
    -------
    (n, k + 1) float64
    """
    passed = smooth_step((time_s[:, None] - edges_s) / width_s + 0.5)
    passed = np.minimum.accumulate(passed, axis=1)  # a wide passage must not begin before the one it follows
    ends = np.ones((len(time_s), 1))
    return -np.diff(np.concatenate([ends, passed, 0 * ends], axis=1), axis=1)


def blend(shares: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Mixture (n, c) of values (k, c) by shares (n, k); summed in one order on every machine, as BLAS does not."""
    return np.einsum("nk,kc->nc", shares, values)


def draw_edges(rng: np.random.Generator, duration_s: float, gap_s: tuple[float, float]) -> np.ndarray:
    """Times in (0, duration) at which something changes, each a uniform gap after the one before."""
    low, high = gap_s
    gaps = low + (high - low) * rng.random(int(duration_s / low) + 1)
    edges = np.cumsum(gaps)
    return edges[edges < duration_s]


def passages(edges_s: np.ndarray, longest_s: np.ndarray | float) -> np.ndarray:
    """Widths (k,) of passages at edges (k,), at most ``longest_s`` and so short that neighbours do not overlap."""
    gaps = np.diff(edges_s, prepend=-np.inf, append=np.inf)
    return np.minimum(longest_s, np.minimum(gaps[:-1], gaps[1:]))


def wander(
    time_s: np.ndarray, edges_s: np.ndarray, values: np.ndarray, longest_s: np.ndarray | float
) -> np.ndarray:
    """Course (n, c) that rests at each of values (k + 1, c) in turn and passes from one to the next at edges (k,)."""
    return blend(memberships(time_s, edges_s, passages(edges_s, longest_s)), values)
