"""What files call the time of a picture, in which unit, and whether numbers are times at all."""

from collections.abc import Iterable

import numpy as np

TIMES = {
    "time_s": 1.0,
    "timestamp_s": 1.0,
    "timestamp_ms": 1e-3,
    "time_ms": 1e-3,
    "timestampMs": 1e-3,
    "timeMs": 1e-3,
    "timestamp": 1.0,
    "time": 1.0,
}
"""Seconds of one, by name; what says no unit is in seconds, as OpenFace writes it. The first one goes before others."""

LATEST_S = 1e19
"""Of a time: nanoseconds since 1970 are less."""

IN_ORDER = 0.9
"""Share of a film's frames that must be later than the one before: rows of two faces a picture share times."""


def time_names(names: Iterable[str]) -> tuple[str, ...]:
    """Those of these names that may be of times, the first choice first."""
    there = set(names)
    return tuple(name for name in TIMES if name in there)


def go_on(time_s: np.ndarray) -> bool:
    """Whether nearly all times (n,) are later than every one before, as those of one film are and durations are not."""
    known = time_s[~np.isnan(time_s)]
    if len(known) < 2:
        return len(known) == 1
    later = known[1:] > np.maximum.accumulate(known)[:-1]
    return bool(np.mean(later) >= IN_ORDER)
