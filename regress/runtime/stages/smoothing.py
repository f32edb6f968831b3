"""Smoothing over time: means of frames, and One-Euro by real timestamps, of weights or landmarks."""

from collections import deque
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.features import align_similarity
from regress.runtime.sample import Sample
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.stage import DelayingStage, Stage
from regress.targets import NETWORKS

_SELDOM = 3
"""Times the last step that a pause is at least, for a mean of frames."""

LONGEST_GAP_S = 0.5
"""Seconds without a face after which smoothing starts afresh: what was before says nothing any more. So it does where
a clock was set back by more."""


EYES_FASTER = 3.0
"""A blink lasts a tenth of a second: the cutoff of eyes is this much higher than a face's."""


def by_region(settings: OneEuro, faster: Mapping[str, float] | None = None) -> np.ndarray:
    """Cutoffs at rest (52,) in Hz, region by region; by default eyes are three times as quick."""
    faster = {"eyes": EYES_FASTER} if faster is None else faster
    cutoffs = np.full(len(BLENDSHAPES), settings.cutoff_hz)
    for network in NETWORKS:
        for name in network.outputs:
            cutoffs[BLENDSHAPE_INDEX[name]] *= faster.get(network.region, 1.0)
    return cutoffs


class OneEuroFilter:
    """One-Euro over rows of numbers as they come.

    Parameters
    ----------
    settings
        Of the filter.
    cutoffs_hz : (k,) float64, optional
        At rest, of each column; ``by_region`` by default.
    """

    def __init__(self, settings: OneEuro, cutoffs_hz: np.ndarray | None = None) -> None:
        self._settings = settings
        self._cutoffs = by_region(settings) if cutoffs_hz is None else cutoffs_hz
        self._time: float | None = None
        self._value = self._speed = np.zeros(len(self._cutoffs))

    def step(self, time_s: float, weights: np.ndarray) -> np.ndarray:
        """Smoothed weights (k,) at a time later than the last, or far before it; rows of NaN pass through."""
        if np.isnan(weights).any():
            return weights
        if self._time is None or abs(time_s - self._time) > LONGEST_GAP_S:
            self._value, self._speed = weights, np.zeros_like(weights)
        else:
            seconds = time_s - self._time
            if not seconds > 0:
                raise InputError(f"time goes from {self._time:g} s to {time_s:g} s; frames must be in order")
            speed = (weights - self._value) / seconds
            self._speed = self._speed + _share(self._settings.speed_cutoff_hz, seconds) * (
                speed - self._speed
            )
            cutoffs = self._cutoffs + self._settings.beta * np.abs(self._speed)
            self._value = self._value + _share(cutoffs, seconds) * (weights - self._value)
        self._time = time_s
        return self._value


LANDMARK_BETA = 10.0
"""Hz more for each face width a second that a landmark moves.

Of 5, 10 and 20 at 1 Hz and 30 frames a second the one nearest to the undisturbed weights of quick and of still
faces (docs/measurements/real-recordings.md): 5 cuts blinks to 0.83 of their height, 20 leaves a fifth more jitter.
"""


class LandmarkSmoothing(Stage):
    """One-Euro over faces as they come, each laid upon the mean shape first.

    What the head does is gone then, and does not lag; features ignore place, size and roll, so the networks
    take the result as it is.

    Parameters
    ----------
    cutoff_hz
        Of a landmark at rest; eyes are not quicker here, as their points' speed tells a blink from jitter.
    mean_shape : (68, 2) float64
        The model's, of width 1.
    """

    def __init__(self, cutoff_hz: float, mean_shape: np.ndarray) -> None:
        settings = OneEuro(cutoff_hz=cutoff_hz, beta=LANDMARK_BETA)
        self._filter = OneEuroFilter(settings, np.full(2 * LANDMARK_COUNT, cutoff_hz))
        self._mean_shape = mean_shape

    def step(self, sample: Sample) -> Sample:
        """The sample with its face (68, 2) smoothed, in face widths; NaN where points are missing.

        Raises
        ------
        InputError
            Where a frame with a face has no time, or one no later than the frame before by up to `LONGEST_GAP_S`.
        """
        if np.isnan(sample.points).any():
            return sample
        if sample.time_s is None or not np.isfinite(sample.time_s):
            raise InputError(f"frame {sample.label} has no time, which smoothing of landmarks needs")
        laid = align_similarity(sample.points[None], self._mean_shape).reshape(-1)
        return replace(sample, points=self._filter.step(sample.time_s, laid).reshape(LANDMARK_COUNT, 2))


class Pauses:
    """Tells a pause from frames that always come so seldom."""

    def __init__(self) -> None:
        self._time_s: float | None = None
        self._step_s: float | None = None

    def before(self, time_s: float | None) -> bool:
        """Whether there was one before the next frame; of a frame without a time nobody knows."""
        last_s, self._time_s = self._time_s, time_s
        if last_s is None or time_s is None:
            return False
        step_s, usual_s = abs(time_s - last_s), self._step_s
        paused = step_s > max(LONGEST_GAP_S, _SELDOM * (usual_s or 0.0))
        if usual_s is None or not paused:
            self._step_s = step_s  # a first one that is long may be a pause, and is taken for one
        return paused


class MovingAverage(Stage):
    """Mean of each frame's weights and gaze and those before it, fewer at the start: what a live stream has.

    Frames without weights keep none, and the means of others leave them out. A pause without frames starts afresh.

    Parameters
    ----------
    frames
        How many, 1 or more.
    """

    def __init__(self, frames: int) -> None:
        self._recent: deque[np.ndarray] = deque(maxlen=frames)
        self._pauses = Pauses()

    def step(self, sample: Sample) -> Sample:
        """The sample with the mean weights and gaze."""
        if self._pauses.before(sample.time_s):
            self._recent.clear()
        row = joined(sample)
        self._recent.append(row)
        return sample if np.isnan(row).any() else with_row(sample, np.nanmean(self._recent, axis=0))


class MeanSmoothing(DelayingStage):
    """Mean of each frame's weights and gaze and its neighbours', fewer at the ends; none across a gap.

    Frames without weights keep none, and the means of others leave them out.

    Parameters
    ----------
    behind, ahead
        How many frames before and after it count.
    """

    def __init__(self, behind: int, ahead: int = 0) -> None:
        self._behind, self._ahead = behind, ahead
        self._recent: deque[tuple[Sample, np.ndarray]] = deque()
        self._given = 0
        self._pauses = Pauses()

    def feed(self, sample: Sample) -> list[Sample]:
        """The sample of ``ahead`` frames ago, with mean weights and gaze."""
        held = self.finish() if self._pauses.before(sample.time_s) else []
        self._recent.append((sample, joined(sample)))
        return [*held, self._next()] if len(self._recent) - self._given > self._ahead else held

    def finish(self) -> list[Sample]:
        """Samples that still wait, with the mean of those that there are; the next one starts afresh."""
        held = [self._next() for _ in range(len(self._recent) - self._given)]
        self._recent.clear()
        self._given = 0
        return held

    def _next(self) -> Sample:
        """The first of those that were not given yet; what lies too far behind it is forgotten."""
        if self._given > self._behind:
            self._recent.popleft()
            self._given -= 1
        sample, row = self._recent[self._given]
        rows = [near for _, near in list(self._recent)[: self._given + self._ahead + 1]]
        self._given += 1
        return sample if np.isnan(row).any() else with_row(sample, np.nanmean(rows, axis=0))


class OneEuroSmoothing(Stage):
    """One-Euro over weights and gaze by the frames' times; a gaze is as quick as the shapes of the eyes.

    Parameters
    ----------
    settings
        Of the filter.
    faster
        Factor on the cutoff by region of the face; eyes alone by default.
    """

    def __init__(self, settings: OneEuro, faster: Mapping[str, float] | None = None) -> None:
        self._settings, self._faster = settings, faster
        self._filter: OneEuroFilter | None = None

    def step(self, sample: Sample) -> Sample:
        """The sample with smoothed weights and gaze.

        Raises
        ------
        InputError
            Where a frame with weights has no time, or one no later than the frame before by up to `LONGEST_GAP_S`; the
            message has its label.
        """
        row = joined(sample)
        if np.isnan(row).any():
            return sample
        if sample.time_s is None or not np.isfinite(sample.time_s):
            raise InputError(f"frame {sample.label} has no time, which One-Euro smoothing needs")
        if self._filter is None:
            gaze_hz = EYES_FASTER * self._settings.cutoff_hz
            cutoffs_hz = np.append(
                by_region(self._settings, self._faster), np.full(len(row) - len(sample.weights), gaze_hz)
            )
            self._filter = OneEuroFilter(self._settings, cutoffs_hz)
        try:
            return with_row(sample, self._filter.step(sample.time_s, row))
        except InputError as error:
            raise InputError(f"frame {sample.label}: {error}") from error


def joined(sample: Sample) -> np.ndarray:
    """Weights, and the gaze behind them where there is one."""
    return sample.weights if sample.gaze is None else np.concatenate([sample.weights, sample.gaze])


def with_row(sample: Sample, row: np.ndarray) -> Sample:
    """The sample with weights and gaze of a row as `joined` makes it."""
    if sample.gaze is None:
        return replace(sample, weights=row)
    return replace(sample, weights=row[: len(sample.weights)], gaze=row[len(sample.weights) :])


def _share(cutoff_hz: float | np.ndarray, seconds: float) -> float | np.ndarray:
    """How much of a new value a first-order low pass takes."""
    turn = 2 * np.pi * seconds * cutoff_hz
    return turn / (turn + 1)
