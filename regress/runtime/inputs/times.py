"""What files call the time of a picture, and in which unit."""

from collections.abc import Iterable

TIMES = {
    "timestamp": 1.0,
    "time_s": 1.0,
    "timestamp_s": 1.0,
    "time": 1.0,
    "timestamp_ms": 1e-3,
    "time_ms": 1e-3,
    "timestampMs": 1e-3,
    "timeMs": 1e-3,
}
"""Seconds of one, by name; what says no unit is in seconds, as OpenFace writes it. The first one goes before others."""

LATEST_S = 1e19
"""Of a time: nanoseconds since 1970 are less."""


def time_name(names: Iterable[str]) -> str | None:
    """The name of the time among these, if it is there."""
    there = set(names)
    return next((name for name in TIMES if name in there), None)
