"""Rounds numbers to the steps of the wire, the same way in every language."""

import math

from room.errors import FormatError

METRE_STEPS = 1000
UNIT_STEPS = 32767

UNIT_TOLERANCE = 0.01
"""How far a rotation's length may be from 1: rounding moves it by .00003, and a sender's own floats by less."""


def nearest(value: float) -> int:
    """Nearest whole number, halves up: the same in every language, unlike Python's own to the even one."""
    return math.floor(value + 0.5)


def held(value: float, steps: float, least: int, most: int) -> int:
    """Steps of a value, held to a range."""
    # held before it is rounded, so that no float is too large to become a whole number
    return nearest(min(max(value * steps, least), most))


def check_unit(name: str, length: float) -> None:
    """Refuse a rotation that is none."""
    if abs(length - 1) > UNIT_TOLERANCE:
        raise FormatError(f"{name}: has length {length:.3f}, and must have 1")
