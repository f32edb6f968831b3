"""Reads and writes numbers as people write them: ``0-99,140,200-240:10``."""

import re
from collections.abc import Sequence

from facegen.errors import InputError

_PIECE = re.compile(r"(\d+)(?:-(\d+)(?::(\d+))?)?")


def parse_ranges(text: str, *, where: str) -> tuple[range, ...]:
    """Ranges of a list such as ``"0-99,140,200-240:10"``, ends included; an empty text gives none.

    Raises
    ------
    InputError
        If a piece is not a number, ``first-last`` or ``first-last:step``; ``where`` names its origin.
    """
    ranges = []
    for piece in filter(None, (part.strip() for part in text.split(","))):
        match = _PIECE.fullmatch(piece)
        if match is None:
            raise InputError(f"{where}: {piece!r} is not a sample number, 'first-last' or 'first-last:step'")
        first = int(match[1])
        last = int(match[2]) if match[2] else first
        step = int(match[3]) if match[3] else 1
        if last < first or step < 1:
            raise InputError(
                f"{where}: {piece!r} counts backwards; write 'first-last' with first <= last, step >= 1"
            )
        ranges.append(range(first, last + 1, step))
    return tuple(ranges)


def sample_numbers(text: str, *, total: int, where: str, what: str = "sample") -> list[int]:
    """Sorted numbers of a list of ranges, each below ``total``; ``what`` they count is said in messages.

    Raises
    ------
    InputError
        If a number is not below ``total``.
    """
    numbers: set[int] = set()
    for piece in parse_ranges(text, where=where):
        if piece[-1] >= total:
            raise InputError(
                f"{where}: {what} {piece[-1]} does not exist; this dataset has {what}s 0-{total - 1}"
            )
        numbers.update(piece)
    return sorted(numbers)


def format_ranges(numbers: Sequence[int], *, separator: str = ",") -> str:
    """Ascending numbers as people write them: ``[0, 1, 2, 7]`` gives ``"0-2,7"``, which `sample_numbers` reads."""
    pieces: list[list[int]] = []
    for number in numbers:
        if pieces and number == pieces[-1][1] + 1:
            pieces[-1][1] = number
        else:
            pieces.append([number, number])
    return separator.join(f"{first}-{last}" if last > first else str(first) for first, last in pieces)
