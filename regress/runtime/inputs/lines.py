"""Frames as lines of text, as they come on a pipe: 136 numbers each, or the time before them as well."""

import io
import math
from collections.abc import Iterable, Iterator
from typing import TextIO

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.faults import Fault
from regress.runtime.inputs.orders import split_irises
from regress.runtime.sample import Sample

_NUMBERS = 2 * LANDMARK_COUNT
_WITH_IRISES = _NUMBERS + 4

MOST_CHARACTERS = 64 * 1024
"""Of a line: 137 numbers of 17 digits take 3,500. What follows up to the line's end is passed over."""

MOST_BAD_AT_START = 100
"""Lines that are no frames before the first one that is; a stream that goes on like this is something else."""

_NOT_TEXT = "\ufffd"
"""What stands in a line for bytes that are not UTF-8."""


def text_lines(stream: TextIO) -> Iterator[str]:
    """Lines of a stream as they come, in bounded memory; bytes that are no text become what no number has.

    They are UTF-8 on every system, and a byte order mark, as editors on Windows write it, is no part of the first one.
    """
    if isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(encoding="utf-8-sig", errors="replace")
    while line := stream.readline(MOST_CHARACTERS):
        whole = len(line) < MOST_CHARACTERS or line.endswith("\n")
        yield line if whole else "a line that is too long"
        while not whole and (rest := stream.readline(MOST_CHARACTERS)):
            whole = rest.endswith("\n")


def read_lines(lines: Iterable[str], *, fps: float | None = None) -> Iterator[Sample]:
    """Samples of lines, each as soon as it comes; labels count from 1.

    The first frame says whether frames have times, and irises; empty lines before it wait for it. A line that is no
    frame has a fault and costs no more than itself.

    Parameters
    ----------
    lines
        136 numbers ``x y x y ...`` each, or 140 with the subject's right and left iris behind them; one more with the
        time in seconds first; separated by blanks or commas. An empty line, or one with nan, is a frame without a face.
    fps
        Frames a second; goes before times in lines.

    Raises
    ------
    InputError
        Where no line is a frame and some are something else, or `MOST_BAD_AT_START` of them come before the first one.
    """
    timed, eyes = fps is not None, False
    waiting = _Waiting()
    for number, line in enumerate(lines, start=1):
        try:
            time_s, numbers = _frame(line, number, fps)
        except _NoFrame as reason:
            fault, time_s, numbers = Fault.UNREADABLE, reason.time_s, []
            waiting.refuse(reason)
        else:
            fault = None
        if not waiting.over and not numbers:
            waiting.add(fault, time_s)
            continue
        if not waiting.over:
            timed, eyes = time_s is not None, len(numbers) == _WITH_IRISES
            yield from waiting.samples(timed=timed, eyes=eyes)
        yield _sample(str(number), time_s, numbers, timed=timed, eyes=eyes, fault=fault)
    if not waiting.over:
        waiting.check()
        yield from waiting.samples(timed=timed, eyes=False)


class _NoFrame(Exception):
    """A line that is neither a frame nor empty; the message is a sentence, and its time counts where it is known."""

    def __init__(self, message: str, time_s: float | None) -> None:
        super().__init__(message)
        self.time_s = time_s


class _Waiting:
    """Lines before the first frame: their times and faults, and what was wrong with the first that has one."""

    def __init__(self) -> None:
        self.over = False
        self._lines: list[tuple[Fault | None, float | None]] = []
        self._refused: _NoFrame | None = None
        self._bad = 0

    def refuse(self, reason: _NoFrame) -> None:
        """Note a line that is no frame, unless there was one; too many of them are not waited for."""
        self._refused, self._bad = self._refused or reason, self._bad + 1
        if not self.over and self._bad >= MOST_BAD_AT_START:
            self.check()

    def add(self, fault: Fault | None, time_s: float | None) -> None:
        self._lines.append((fault, time_s))

    def check(self) -> None:
        """Refuse a stream of which nothing but something else has come."""
        if self._refused is not None:
            raise InputError(str(self._refused)) from self._refused

    def samples(self, *, timed: bool, eyes: bool) -> Iterator[Sample]:
        self.over = True
        for number, (fault, time_s) in enumerate(self._lines, start=1):
            yield _sample(str(number), time_s, [], timed=timed, eyes=eyes, fault=fault)


def _frame(line: str, number: int, fps: float | None) -> tuple[float | None, list[float]]:
    """Time and 136 or 140 numbers of a line, none of an empty one."""
    time_s = None if fps is None else (number - 1) / fps
    if _NOT_TEXT in line:
        raise _NoFrame(
            f"standard input is not text (line {number}); lines of {_NUMBERS} numbers are needed, and files are read "
            "by name",
            time_s,
        )
    try:
        numbers = [float(cell) for cell in line.replace(",", " ").split()]
    except ValueError as error:
        raise _NoFrame(
            f"line {number} holds something that is not a number ({str(error)[:80]})", time_s
        ) from error
    if len(numbers) not in (0, _NUMBERS, _NUMBERS + 1, _WITH_IRISES, _WITH_IRISES + 1):
        raise _NoFrame(
            f"line {number} has {len(numbers)} numbers; {_NUMBERS} are needed (x y x y ...), "
            f"or the time before them as well; the irises may stand behind them",
            time_s,
        )
    if len(numbers) in (0, _NUMBERS, _WITH_IRISES):
        return time_s, numbers
    if fps is None and not math.isfinite(numbers[0]):
        raise _NoFrame(f"line {number} has {numbers[0]} for a time", time_s)
    return (numbers[0] if fps is None else time_s), numbers[1:]


def _sample(
    label: str, time_s: float | None, numbers: list[float], *, timed: bool, eyes: bool, fault: Fault | None
) -> Sample:
    # a line of a stream with irises may lack them
    numbers = (numbers or [math.nan] * _NUMBERS) + [math.nan] * 4
    points, irises = split_irises(np.array(numbers[:_WITH_IRISES]).reshape(1, -1, 2))
    if timed and time_s is None:
        time_s = math.nan
    return Sample(
        label=label,
        time_s=time_s if timed else None,
        points=points[0],
        irises=irises[0] if eyes else None,
        faults={} if fault is None else {"points": fault},
    )
