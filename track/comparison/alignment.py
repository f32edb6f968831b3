"""Finds by how much one recording of a face is later than another, from what both show."""

from dataclasses import dataclass

import numpy as np

WITHIN_S = 1.0
"""Of a delay either way: networks and encoders of phones take a tenth of it."""

COARSE_S, FINE_S = 0.01, 0.001
"""Steps of the search, and of the second one about the best of the first."""

MOVING = 0.02
"""Standard deviation of a weight, in both recordings, from which it counts."""

FEWEST_S = 5.0
"""Of a recording: shorter ones align by chance."""

CERTAIN = 0.3
"""Mean correlation of moving shapes at the best delay below which it is none: at wrong delays of a minute's talk it is
below .2."""


@dataclass(frozen=True, kw_only=True)
class Alignment:
    """A delay, and how sure it is.

    Parameters
    ----------
    delay_s
        By how much the second recording is later than the first.
    correlation
        Mean over the moving shapes at this delay.
    shapes
        How many count.
    """

    delay_s: float
    correlation: float
    shapes: int

    @property
    def certain(self) -> bool:
        """Whether the two show the same face."""
        return self.shapes > 0 and self.correlation >= CERTAIN


def align(
    first_s: np.ndarray,
    first: np.ndarray,
    second_s: np.ndarray,
    second: np.ndarray,
    *,
    within_s: float = WITHIN_S,
) -> Alignment:
    """Compare two recordings of one face.

    Parameters
    ----------
    first_s, second_s : (n,), (m,) float64
        Times, rising, by one clock.
    first, second : (n, k), (m, k) float64
        Weights.
    """
    begin, end = max(first_s[0], second_s[0]) + within_s, min(first_s[-1], second_s[-1]) - within_s
    counted = (first_s >= begin) & (first_s <= end)
    if end - begin < FEWEST_S or counted.sum() < 2:
        return Alignment(delay_s=0.0, correlation=0.0, shapes=0)
    moving = (first[counted].std(axis=0) > MOVING) & (second.std(axis=0) > MOVING)
    if not moving.any():
        return Alignment(delay_s=0.0, correlation=0.0, shapes=0)
    times_s, seen = first_s[counted], _standard(first[counted][:, moving])

    def likeness(delay_s: float) -> float:
        return float(
            (seen * _standard(at(times_s + delay_s, second_s, second[:, moving]))).sum(axis=0).mean()
        )

    coarse = np.arange(-within_s, within_s + COARSE_S / 2, COARSE_S)
    best = coarse[int(np.argmax([likeness(delay_s) for delay_s in coarse]))]
    fine = best + np.arange(-COARSE_S, COARSE_S + FINE_S / 2, FINE_S)
    scores = [likeness(delay_s) for delay_s in fine]
    chosen = int(np.argmax(scores))
    return Alignment(delay_s=float(fine[chosen]), correlation=scores[chosen], shapes=int(moving.sum()))


def at(times_s: np.ndarray, known_s: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Values (n, k) at other times, on straight lines between known ones."""
    return np.stack([np.interp(times_s, known_s, column) for column in known.T], axis=1)


def _standard(values: np.ndarray) -> np.ndarray:
    """Columns about their means, of length 1."""
    centred = values - values.mean(axis=0)
    return centred / np.maximum(np.linalg.norm(centred, axis=0), 1e-12)
