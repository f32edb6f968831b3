"""Reads what the names of a camera's pictures say: their order, the frames' numbers, and times of a clock."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from facegen.formats.natural_order import natural_order
from regress.runtime.headset.recordings.name_times import NameTimes, decimal_seconds, may_be_times, name_times

_MOST_NUMBER = 2**62
"""A frame's number is less: nanoseconds since 1970 are, and differences of numbers still fit 64 bits."""

_DIGITS = re.compile(r"(\d+)")
_LAST_NUMBER = re.compile(r"(.*?)(\d+)\D*", re.DOTALL)
"""What stands before the last number of a file's name, and that number, before its ending."""

_CLOCK = re.compile(r"\D*\d{9,}\.\d+")
"""Seconds since 1970 with a fraction, behind what all names begin with."""

_TICKS_A_SECOND = {10: 1.0, 13: 1e3, 16: 1e6, 19: 1e9}
"""By how many digits a number of seconds, milliseconds, microseconds or nanoseconds since 1970 has, 2001 to 2286."""


@dataclass(frozen=True, kw_only=True)
class FrameNames:
    """The pictures of a folder in the order of time.

    Parameters
    ----------
    files
        In order.
    numbers
        What the frames are called; None where names do not count them.
    time_s
        Seconds of a clock; None where names are not times.
    odd
        A file whose name is not like the others', where names do not count frames.
    """

    files: tuple[Path, ...]
    numbers: tuple[int, ...] | None = None
    time_s: tuple[float, ...] | None = None
    odd: Path | None = None


def frame_names(files: Sequence[Path]) -> FrameNames:
    """The order of pictures, one or more, by what differs in their names: a number, or a time, a counter beside it.

    Where other digits or words differ as well, a number says only a part of the order, and none is taken.
    """
    files = sorted(files)
    stems = [file.stem for file in files]
    decimals = decimal_seconds(stems)
    if decimals is not None and all(_CLOCK.fullmatch(stem) for stem in stems):
        return _by_seconds(files, decimals)
    numbers, times = _counted(stems), name_times(stems)
    clocked = None if times is None else _by_clock(files, times, numbers)
    if clocked is not None:
        return clocked
    if numbers is not None and len(set(numbers)) == len(files) and max(numbers) < _MOST_NUMBER:
        pairs = sorted(zip(numbers, files, strict=True))
        counted = tuple(number for number, _ in pairs)
        ticks = _TICKS_A_SECOND[len(str(counted[0]))] if _are_ticks(counted) else None
        # differences are exact, where nanoseconds since 1970 are not
        time_s = (
            None if ticks is None else [counted[0] / ticks + (each - counted[0]) / ticks for each in counted]
        )
        return FrameNames(
            files=tuple(file for _, file in pairs),
            numbers=counted,
            time_s=None if time_s is None else tuple(time_s),
        )
    if decimals is not None:
        return _by_seconds(files, decimals)
    return FrameNames(files=tuple(sorted(files, key=lambda file: natural_order(file.stem))), odd=_odd(files))


def _by_seconds(files: Sequence[Path], seconds: Sequence[Decimal]) -> FrameNames:
    pairs = sorted(zip(seconds, files, strict=True))
    known = len(set(seconds)) == len(files) and (_CLOCK.fullmatch(files[0].stem) or may_be_times(seconds))
    return FrameNames(
        files=tuple(file for _, file in pairs),
        time_s=tuple(float(second) for second, _ in pairs) if known else None,
    )


def _by_clock(files: Sequence[Path], times: NameTimes, numbers: Sequence[int] | None) -> FrameNames | None:
    """The order by a clock, or by the counter beside one that tells whole seconds; None where neither is one.

    A counter beside a clock counts pictures, also where the camera lost some, so the clock says which go together.
    """
    alone = len(set(times.rests)) == 1
    if alone and numbers is not None and _are_ticks(numbers):
        return None  # such names are numbers as well
    counters = None if alone else _counted(times.rests)
    if counters is None:
        counters = range(len(files)) if alone else ()
    if len(set(counters)) < len(files):
        return None
    rows = sorted(range(len(files)), key=lambda row: (times.seconds[row], counters[row]))
    apart = len(set(times.seconds)) == len(files)
    if not alone and [counters[row] for row in rows] != sorted(counters):
        return None
    if not apart and (alone or max(counters) >= _MOST_NUMBER):
        return None
    return FrameNames(
        files=tuple(files[row] for row in rows),
        time_s=tuple(float(times.seconds[row]) for row in rows) if apart else None,
        numbers=None if apart else tuple(counters[row] for row in rows),
    )


def _are_ticks(numbers: Sequence[int]) -> bool:
    """Whether numbers are those of a clock since 1970."""
    digits = {len(str(number)) for number in numbers}
    return len(digits) == 1 and digits.pop() in _TICKS_A_SECOND


def _counted(stems: Sequence[str]) -> list[int] | None:
    """The number in each name that alone differs; the last one, where what stands before it is the same."""
    found = [_LAST_NUMBER.fullmatch(stem) for stem in stems]
    if all(found) and len({match[1] for match in found}) == 1:
        return [int(match[2]) for match in found]
    pieces = [_DIGITS.split(stem) for stem in stems]
    if len({len(each) for each in pieces}) > 1:
        return None
    varying = [place for place, each in enumerate(zip(*pieces, strict=True)) if len(set(each)) > 1]
    return [int(each[varying[0]]) for each in pieces] if len(varying) == 1 and varying[0] % 2 else None


def _odd(files: Sequence[Path]) -> Path | None:
    """A file without which names would count frames."""
    texts = ["#".join(_DIGITS.split(file.stem)[::2]) for file in files]
    usual = max(set(texts), key=texts.count)
    strange = [file for file, text in zip(files, texts, strict=True) if text != usual]
    return strange[0] if "#" in usual and 0 < len(strange) < 0.1 * len(files) else None
