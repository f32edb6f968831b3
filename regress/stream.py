"""Frames that come one by one, on a pipe: a line of landmarks in, a line of weights out."""

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.model import Model
from regress.neutral import estimate_neutral
from regress.predict import Output, csv_header, csv_row
from regress.smoothing import OneEuroStream

_NUMBERS = 2 * LANDMARK_COUNT

ESTIMATE_EVERY = 30
"""Frames between two estimates of the neutral face: a second of video."""

_REMEMBERED = 900
"""Frames that an estimate looks back on: half a minute of video."""


class RunningNeutral:
    """Looks for the neutral face while frames come, until it is sure; then the model is calibrated for good.

    Parameters
    ----------
    model
        With calibrated networks; serves without a neutral frame until one is found.
    say
        Told when it is sure, and why.
    """

    def __init__(self, model: Model, say: Callable[[str], None]) -> None:
        self.model = model
        self._say = say
        self._seen: deque[np.ndarray] = deque(maxlen=_REMEMBERED)
        self._count = 0
        self._searching = True

    def step(self, points: np.ndarray) -> None:
        """Take a frame (68, 2) into account; frames with NaN are left out."""
        if not self._searching or not np.isfinite(points).all():
            return
        self._seen.append(points)
        self._count += 1
        if self._count % ESTIMATE_EVERY:
            return
        seen = np.array(self._seen)
        estimate = estimate_neutral(self.model, seen)
        if estimate.sure:
            self.model = self.model.calibrate(seen[estimate.frames])
            self._searching = False
            self._say(f"frame {self._count}: neutral face found ({estimate.reason}); calibrated from here on")


def stream_csv(
    lines: Iterable[str],
    model: Model,
    output: Output,
    *,
    fps: float | None = None,
    auto: bool = False,
    say: Callable[[str], None] = lambda message: None,
) -> Iterator[str]:
    """Lines of a CSV of weights, each as soon as its frame is known.

    Parameters
    ----------
    lines
        136 numbers ``x y x y ...`` each, or 137 with the time in seconds first; separated by blanks or
        commas. An empty line, or one with nan, is a frame without a face.
    model, output
        What to run, and what happens after it.
    fps
        Frames a second, where lines carry no time.
    auto
        Whether to look for the neutral face.
    say
        Told what a person should know.

    Raises
    ------
    InputError
        A line that is not a frame, or times out of order; the message has the line's number.
    """
    running = RunningNeutral(model, say) if auto else None
    recent: deque[np.ndarray] = deque(maxlen=output.smooth)
    filtered = None if output.one_euro is None else OneEuroStream(output.one_euro)
    for number, line in enumerate(lines, start=1):
        time_s, points = _frame(line, number)
        if time_s is None and fps is not None:
            time_s = (number - 1) / fps
        if number == 1:
            timed = time_s is not None
            yield csv_header(timed=timed)
        if running is not None:
            running.step(points)
            model = running.model
        weights = model.predict(points[None])[0]
        recent.append(weights)
        if not np.isnan(weights).any():
            weights = np.nanmean(recent, axis=0)
            if filtered is not None:
                if time_s is None:
                    raise InputError(f"line {number} has no time, which One-Euro smoothing needs; give --fps")
                weights = filtered.step(time_s, weights)
        yield csv_row(str(number), time_s if timed else None, output.finish(weights[None])[0])


def _frame(line: str, number: int) -> tuple[float | None, np.ndarray]:
    cells = line.replace(",", " ").split()
    if not cells:
        return None, np.full((LANDMARK_COUNT, 2), np.nan)
    try:
        numbers = [float(cell) for cell in cells]
    except ValueError as error:
        raise InputError(f"line {number} holds something that is not a number ({error})") from error
    if len(numbers) not in (_NUMBERS, _NUMBERS + 1):
        raise InputError(
            f"line {number} has {len(numbers)} numbers; {_NUMBERS} are needed (x y x y ...), "
            f"or the time before them as well"
        )
    time_s = numbers.pop(0) if len(numbers) > _NUMBERS else None
    if time_s is not None and not math.isfinite(time_s):
        raise InputError(f"line {number} has {time_s} for a time")
    return time_s, np.array(numbers).reshape(LANDMARK_COUNT, 2)
