"""Sample numbers as people write them: ``0-99,140,200-240:10``."""

import re

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
            raise InputError(f"{where}: {piece!r} counts backwards; write 'first-last' with first <= last, step >= 1")
        ranges.append(range(first, last + 1, step))
    return tuple(ranges)


def sample_numbers(text: str, *, total: int, where: str) -> list[int]:
    """Sorted sample numbers of a list of ranges, each below ``total``.

    Raises
    ------
    InputError
        If a number is not below ``total``.
    """
    numbers: set[int] = set()
    for piece in parse_ranges(text, where=where):
        if piece[-1] >= total:
            raise InputError(f"{where}: sample {piece[-1]} does not exist; this dataset has samples 0-{total - 1}")
        numbers.update(piece)
    return sorted(numbers)
