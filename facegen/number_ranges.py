"""Reads and writes numbers as people write them: ``0-99,140,200-240:10``."""

import itertools
import re
from collections.abc import Iterable, Iterator, Sequence

from facegen.errors import InputError

MOST_LISTED = 10_000_000
"""Numbers that are listed one by one, in some 400 MB; one range without a step is never listed."""

_PIECE = re.compile(r"([0-9]{1,18})(?:-([0-9]{1,18})(?::([0-9]{1,18}))?)?")


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


def sample_ranges(text: str, *, total: int, where: str, what: str = "sample") -> Sequence[int]:
    """Sorted numbers of a list of ranges, each below ``total``; ``what`` they count is said in messages.

    Returns
    -------
    range or list
        A range where the text is one without a step: it may count more than fit into memory. Else a list.

    Raises
    ------
    InputError
        If a number is not below ``total``, or more than `MOST_LISTED` would have to be listed.
    """
    pieces = parse_ranges(text, where=where)
    for piece in pieces:
        if piece[-1] >= total:
            raise InputError(f"{where}: {what} {piece[-1]} does not exist; there are {what}s 0-{total - 1}")
    if len(pieces) == 1 and pieces[0].step == 1:
        return pieces[0]
    count = sum(map(len, pieces))
    if count > MOST_LISTED:
        raise InputError(
            f"{where}: these are {count:,} {what}s, of which at most {MOST_LISTED:,} are listed at a time; take "
            "fewer, or one range 'first-last'"
        )
    return sorted(set(itertools.chain.from_iterable(pieces)))


def sample_numbers(text: str, *, total: int, where: str, what: str = "sample") -> list[int]:
    """Sorted numbers of a list of ranges as `sample_ranges` gives them, always listed.

    Raises
    ------
    InputError
        If a number is not below ``total``, or they are more than `MOST_LISTED`.
    """
    return listed(sample_ranges(text, total=total, where=where, what=what), where=where, what=what)


def listed(numbers: Sequence[int], *, where: str, what: str) -> list[int]:
    """Numbers as a list.

    Raises
    ------
    InputError
        If they are more than `MOST_LISTED`.
    """
    if len(numbers) > MOST_LISTED:
        raise InputError(
            f"{where}: these are {len(numbers):,} {what}s, of which at most {MOST_LISTED:,} are taken at a time; take "
            "them in slices"
        )
    return list(numbers)


def without(numbers: Sequence[int], taken: Iterable[int]) -> list[range]:
    """Runs of ascending numbers that are not among ``taken``; a range is not listed for it."""
    taken = set(taken)
    if not _is_run(numbers):
        return list(_runs(number for number in numbers if number not in taken))
    edges = [numbers.start - 1, *sorted(number for number in taken if number in numbers), numbers.stop]
    return [range(low + 1, high) for low, high in itertools.pairwise(edges) if low + 1 < high]


def format_ranges(numbers: Iterable[int], *, separator: str = ",") -> str:
    """Ascending numbers as people write them: ``[0, 1, 2, 7]`` gives ``"0-2,7"``, which `sample_numbers` reads."""
    return format_runs([numbers] if _is_run(numbers) and numbers else _runs(numbers), separator=separator)


def format_runs(runs: Iterable[range], *, separator: str = ",") -> str:
    """Ascending runs as people write them: ``[range(3), range(7, 8)]`` gives ``"0-2,7"``."""
    return separator.join(f"{run[0]}-{run[-1]}" if len(run) > 1 else str(run[0]) for run in runs)


def _is_run(numbers: Iterable[int]) -> bool:
    return isinstance(numbers, range) and numbers.step == 1


def _runs(numbers: Iterable[int]) -> Iterator[range]:
    first = last = None
    for number in numbers:
        if last is not None and number == last + 1:
            last = number
            continue
        if last is not None:
            yield range(first, last + 1)
        first = last = number
    if last is not None:
        yield range(first, last + 1)
