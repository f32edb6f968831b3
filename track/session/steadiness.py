"""Whether a face kept still: how far it went on the way, against what its detector's noise alone would show."""

from dataclasses import dataclass

import numpy as np

from regress.runtime.frame_noise import frame_noise

PARTS = 4
"""Pieces of a recording whose medians are compared: of two seconds each is half a one, which a blink does not move."""

NOISES = 4.0
"""Standard errors of a piece's median beyond which it moved; of 140 coordinates one in a hundred recordings has 4."""

_MEDIANS = 1.2533
"""Standard error of a median over that of a mean."""


@dataclass(frozen=True, kw_only=True)
class Steadiness:
    """How still a recording was.

    Parameters
    ----------
    moved
        Furthest that a value went, in its unit.
    allowed
        How far it may.
    """

    moved: float
    allowed: float

    @property
    def still(self) -> bool:
        """Whether it kept within what is allowed."""
        return self.moved <= self.allowed


def steadiness(values: np.ndarray, *, least: float) -> Steadiness:
    """Judge a recording that should show one face.

    Parameters
    ----------
    values : (n, k) float64
        Of each frame, in the order of time; 8 frames or more.
    least
        Of a movement that counts, however small the noise is.
    """
    noise = frame_noise(values)
    pieces = [np.median(piece, axis=0) for piece in np.array_split(values, PARTS)]
    moved = np.ptp(pieces, axis=0)
    error = _MEDIANS * 2**0.5 * noise / np.sqrt(len(values) / PARTS)
    over = moved - np.maximum(least, NOISES * error)
    worst = int(np.argmax(over))
    return Steadiness(moved=float(moved[worst]), allowed=float(moved[worst] - over[worst]))
