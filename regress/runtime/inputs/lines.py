"""Frames as lines of text, as they come on a pipe: 136 numbers each, or the time before them as well."""

import math
from collections.abc import Iterable, Iterator

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.sample import Sample

_NUMBERS = 2 * LANDMARK_COUNT


def read_lines(lines: Iterable[str], *, fps: float | None = None) -> Iterator[Sample]:
    """Samples of lines, each as soon as it comes; labels count from 1.

    The first line that is not empty says whether frames have times; empty ones before it wait for it.

    Parameters
    ----------
    lines
        136 numbers ``x y x y ...`` each, or 137 with the time in seconds first; separated by blanks or
        commas. An empty line, or one with nan, is a frame without a face.
    fps
        Frames a second; goes before times in lines.

    Raises
    ------
    InputError
        A line that is not a frame; the message has its number.
    """
    timed = None if fps is None else True
    waiting: list[str] = []
    for number, line in enumerate(lines, start=1):
        numbers = _numbers_of(line, number)
        time_s = numbers.pop(0) if len(numbers) > _NUMBERS else None
        if fps is not None:
            time_s = (number - 1) / fps
        elif time_s is not None and not math.isfinite(time_s):
            raise InputError(f"line {number} has {time_s} for a time")
        if timed is None and not numbers:
            waiting.append(str(number))
            continue
        if timed is None:
            timed = time_s is not None
            yield from (_sample(label, None, [], timed=timed) for label in waiting)
        yield _sample(str(number), time_s, numbers, timed=timed)
    if timed is None:
        yield from (_sample(label, None, [], timed=False) for label in waiting)


def _numbers_of(line: str, number: int) -> list[float]:
    cells = line.replace(",", " ").split()
    try:
        numbers = [float(cell) for cell in cells]
    except ValueError as error:
        raise InputError(f"line {number} holds something that is not a number ({error})") from error
    if len(numbers) not in (0, _NUMBERS, _NUMBERS + 1):
        raise InputError(
            f"line {number} has {len(numbers)} numbers; {_NUMBERS} are needed (x y x y ...), "
            f"or the time before them as well"
        )
    return numbers


def _sample(label: str, time_s: float | None, numbers: list[float], *, timed: bool) -> Sample:
    points = np.array(numbers or [math.nan] * _NUMBERS).reshape(LANDMARK_COUNT, 2)
    if timed and time_s is None:
        time_s = math.nan
    return Sample(label=label, time_s=time_s if timed else None, points=points)
