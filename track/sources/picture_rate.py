"""Measures how many pictures a second a camera really gives: drivers tell the rate of their list."""

from collections.abc import Sequence

import numpy as np

SETTLING_S = 0.5
"""Not looked at after the first picture: exposure finds the room's light, and buffers empty."""

MEASURED_S = 1.0
"""Of pictures from then on."""


def rate_of(times_s: Sequence[float]) -> float | None:
    """Pictures a second by the median gap, so that a pause of the machine counts little; None of fewer than three."""
    gaps_s = np.diff(times_s)
    median_s = float(np.median(gaps_s)) if len(gaps_s) > 1 else 0.0
    return 1 / median_s if median_s > 0 else None


class RateWatch:
    """Takes the times of a camera's pictures and gives its rate once."""

    def __init__(self) -> None:
        self._first_s: float | None = None
        self._times_s: list[float] | None = []

    def step(self, time_s: float) -> float | None:
        """Take a picture's time; the rate with the one that completes it."""
        if self._times_s is None:
            return None
        if self._first_s is None:
            self._first_s = time_s
        if time_s - self._first_s >= SETTLING_S:
            self._times_s.append(time_s)
        if len(self._times_s) < 3 or self._times_s[-1] - self._times_s[0] < MEASURED_S:
            return None
        times_s, self._times_s = self._times_s, None
        return rate_of(times_s)
