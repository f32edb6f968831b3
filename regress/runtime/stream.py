"""Frames that come one by one, on a pipe: a line of landmarks in, a line of weights out."""

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs import Fault, TimeOrder, face_faults
from regress.runtime.model import FastPredictor, Model
from regress.runtime.neutral import estimate_neutral
from regress.runtime.predict import Output, csv_header, csv_row
from regress.runtime.smoothing import LandmarkStream, OneEuroStream

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

    Raises
    ------
    InputError
        Where the model has no calibrated networks.
    """

    def __init__(self, model: Model, say: Callable[[str], None]) -> None:
        if model.calibrated is None:
            raise InputError("the model has no calibrated networks, so a neutral frame is of no use to it")
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


class FaultRuns:
    """Tells of faulty lines run by run, so that a face that is away for a minute is one sentence.

    Parameters
    ----------
    say
        Told of each run when it ends.
    """

    def __init__(self, say: Callable[[str], None]) -> None:
        self._say = say
        self._fault: Fault | None = None
        self._first = 1

    def step(self, number: int, fault: Fault | None) -> None:
        """Take the fault of a line into account; lines are counted from 1."""
        if fault is not self._fault:
            if self._fault is not None:
                lines = (
                    f"line {self._first} has"
                    if number == self._first + 1
                    else (f"lines {self._first}-{number - 1} have")
                )
                self._say(f"{lines} {self._fault.value}")
            self._fault, self._first = fault, number


class WeightStream:
    """Weights of frames that come one by one: the same as `predict_frames` gives of them all, to 1e-5.

    Parameters
    ----------
    model, output
        What to run, and what happens before and after it.
    """

    def __init__(self, model: Model, output: Output) -> None:
        self._output = output
        self._recent: deque[np.ndarray] = deque(maxlen=output.smooth)
        self._filter = None if output.one_euro is None else OneEuroStream(output.one_euro)
        cutoff_hz, mean_shape = output.smooth_landmarks_hz, model.features.mean_shape
        self._landmarks = None if cutoff_hz is None else LandmarkStream(cutoff_hz, mean_shape)
        self.use(model)

    def use(self, model: Model) -> None:
        """Go on with another model, as one that has been calibrated."""
        self._fast = FastPredictor(model)

    def step(self, time_s: float | None, points: np.ndarray) -> np.ndarray:
        """Weights (k,) of the next face (68, 2); NaN where it has none. Times are later each time, where needed."""
        if not np.isfinite(points).all():
            weights = np.full(len(BLENDSHAPES), np.nan)
            self._recent.append(weights)
            return self._output.finish(weights[None])[0]
        if self._landmarks is not None:
            points = self._landmarks.step(time_s, points)
        weights = self._fast.predict_frame(points).astype(np.float64)
        self._recent.append(weights)
        if len(self._recent) > 1:
            weights = np.nanmean(self._recent, axis=0)
        if self._filter is not None:
            weights = self._filter.step(time_s, weights)
        return self._output.finish(weights[None])[0]


class _Rows:
    """Rows of the CSV, which wait while no line has said whether frames have times: the header says it first."""

    def __init__(self, names: tuple[str, ...], *, timed: bool | None) -> None:
        self._names, self._timed = names, timed
        self._waiting: list[tuple[int, float | None, np.ndarray]] = []
        self._begun = False

    def step(self, number: int, time_s: float | None, weights: np.ndarray, *, empty: bool) -> Iterator[str]:
        """Take the weights of a line, and give what can leave; an empty line says nothing of times."""
        self._waiting.append((number, time_s, weights))
        if self._timed is None and not empty:
            self._timed = time_s is not None
        if self._timed is not None:
            yield from self.finish()

    def finish(self) -> Iterator[str]:
        """Give all that waits."""
        if self._waiting and not self._begun:
            self._begun = True
            yield csv_header(self._names, timed=bool(self._timed))
        for number, time_s, weights in self._waiting:
            cell = None if not self._timed else math.nan if time_s is None else time_s
            yield csv_row(str(number), cell, weights)
        self._waiting.clear()


def stream_csv(
    lines: Iterable[str],
    model: Model,
    output: Output,
    *,
    fps: float | None = None,
    auto: bool = False,
    strict: bool = False,
    say: Callable[[str], None] = lambda message: None,
) -> Iterator[str]:
    """Lines of a CSV of weights, each as soon as its frame is known.

    Parameters
    ----------
    lines
        136 numbers ``x y x y ...`` each, or 137 with the time in seconds first; separated by blanks or
        commas. An empty line, or one with nan, is a frame without a face. The first that is not empty says
        whether weights leave with times; empty ones before it wait for it, unless ``fps`` is given.
    model, output
        What to run, and what happens before and after it.
    fps
        Frames a second; goes before times in lines.
    auto
        Whether to look for the neutral face.
    strict
        Whether a faulty frame is an error; otherwise its cells stay empty.
    say
        Told what a person should know.

    Raises
    ------
    InputError
        A line that is not a frame; a frame without a time where smoothing needs one; where ``strict``, a
        faulty frame. The message has the line's number.
    """
    running = RunningNeutral(model, say) if auto else None
    stream, order, runs = WeightStream(model, output), TimeOrder(strictly=output.needs_times), FaultRuns(say)
    number, rows = 0, _Rows(output.names, timed=None if fps is None else True)
    for number, line in enumerate(lines, start=1):
        time_s, points = _frame(line, number)
        if fps is not None:
            time_s = (number - 1) / fps
        elif time_s is not None and not math.isfinite(time_s):
            raise InputError(f"line {number} has {time_s} for a time")
        fault = face_faults(points[None])[0]
        if fault is None and time_s is None and output.needs_times:
            raise InputError(f"line {number} has no time, which smoothing needs; give --fps")
        fault = fault or (None if time_s is None else order.step(time_s))
        if fault is not None and strict:
            raise InputError(f"line {number} has {fault.value}; without --strict its cells stay empty")
        runs.step(number, fault)
        if fault is not None:
            points = np.full_like(points, np.nan)
        elif running is not None:
            before = running.model
            running.step(points)
            if running.model is not before:
                stream.use(running.model)
        yield from rows.step(number, time_s, stream.step(time_s, points), empty=not line.strip(" ,\t\r\n"))
    yield from rows.finish()
    runs.step(number + 1, None)


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
    return time_s, np.array(numbers).reshape(LANDMARK_COUNT, 2)
