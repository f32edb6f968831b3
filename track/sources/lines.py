"""Points from anyone's detector, as lines on standard input."""

import sys
import time
from typing import TextIO

from regress.runtime.inputs import read_lines, text_lines
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
        self._samples, self._fps = read_lines(text_lines(stream)), fps
        self._count, self._begun_s, self._behind_s = 0, time.monotonic(), time.monotonic()

    def read(self) -> Picture | None:
        """The next frame, as soon as it comes; None at the stream's end."""
        sample = next(self._samples, None)
        if sample is None:
            return None
        time_s = sample.time_s
        if time_s is None:
            time_s = time.monotonic() - self._begun_s if self.live else self._count / self._fps
        self._count, self._behind_s = self._count + 1, time.monotonic() - time_s
        fault = sample.faults.get("points")
        return Picture(time_s=time_s, points=sample.points, irises=sample.irises, fault=fault)

    def now_s(self) -> float:
        """What the clock of the newest line shows now."""
        return time.monotonic() - self._behind_s

    def close(self) -> None:
        """Nothing is held."""
