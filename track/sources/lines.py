"""Points from anyone's detector, as lines on standard input."""

import math
import sys
import time
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TextIO

from regress.runtime.inputs import read_lines, text_lines
from regress.runtime.sample import Sample
from track.sources.source import Picture, Source


class Lines(Source):
    """Frames of 68 points, one a line, with the time before them or when they come.

    Parameters
    ----------
    fast
        Whether every line is wanted; else the newest one.
    fps
        Lines a second, of a fast stream without times.
    stream
        Default standard input.
    """

    endless = False
    ends_within_s = 0.2  # nothing ends a wait for standard input: such a thread ends with the program

    def __init__(self, *, fps: float, fast: bool = False, stream: TextIO | None = None) -> None:
        self.title, self.live = "standard input", not fast
        # of its own: a thread that waits in sys.stdin holds a lock that the interpreter wants at its end
        stream = open(sys.stdin.fileno(), encoding="utf-8", closefd=False) if stream is None else stream
        self._samples, self._fps = _begun(read_lines(text_lines(stream)), 1 / fps), fps
        self._count, self._begun_s, self._behind_s = 0, time.perf_counter(), time.perf_counter()

    def read(self) -> Picture | None:
        """The next frame, as soon as it comes; None at the stream's end."""
        sample = next(self._samples, None)
        if sample is None:
            return None
        time_s = sample.time_s
        if time_s is None:
            time_s = time.perf_counter() - self._begun_s if self.live else self._count / self._fps
        self._count += 1
        if math.isfinite(time_s):  # a line without a face has none
            self._behind_s = time.perf_counter() - time_s
        fault = sample.faults.get("points")
        return Picture(time_s=time_s, points=sample.points, irises=sample.irises, fault=fault)

    def now_s(self) -> float:
        """What the clock of the newest line shows now."""
        return time.perf_counter() - self._behind_s

    def close(self) -> None:
        """Nothing is held."""


def _begun(samples: Iterable[Sample], step_s: float) -> Iterator[Sample]:
    """Samples of which those before the first known time come a step each before it; they come together with it."""
    samples, waiting = iter(samples), []
    for sample in samples:
        waiting.append(sample)
        if sample.time_s is None or math.isfinite(sample.time_s):
            break
    for before, sample in zip(range(len(waiting) - 1, -1, -1), waiting, strict=True):
        first_s = waiting[-1].time_s
        yield sample if first_s is None else replace(sample, time_s=first_s - before * step_s)
    yield from samples
