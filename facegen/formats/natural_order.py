"""The order in which people number things: ``frame_2`` before ``frame_10``, and times of a clock in between."""

import re
from decimal import Decimal

NaturalOrder = tuple[list[tuple[Decimal, str]], str]

_NUMBER = re.compile(r"(\d{9,}\.\d+|\d+)")
"""Digits; or seconds since 1970 with a fraction, whose programs leave out zeros at the end."""


def natural_order(name: str) -> NaturalOrder:
    """Key that sorts names by the numbers in them; texts before numbers, and other names have other keys."""
    pieces = _NUMBER.split(name)
    return [
        (Decimal(piece), "") if place % 2 else (Decimal(-1), piece) for place, piece in enumerate(pieces)
    ], name
