"""Filters weights and gaze by Kalman's recursion, with noise that is measured on the way."""

from collections import deque
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, SIDES
from regress.errors import InputError
from regress.runtime.frame_noise import SECOND_DIFFERENCE
from regress.runtime.sample import Sample
from regress.runtime.stages.smoothing import LONGEST_GAP_S, joined, with_row
from regress.runtime.stages.stage import DelayingStage

WANDERING = 3.0
"""Variance that a weight at rest gathers in a second, in variances of its noise.

Of 1, 3 and 10 on two takes at .5, 1 and 2 px: 1 is calmer by a fifth and errs more, 10 leaves a third more jitter.
"""

SURPRISE = 3.0
"""Standard deviations off its prediction from which a weight is believed to move; what is more counts as wandering.

So a blink keeps its height and a step does not lag. Of 2.5, 3 and 4 all err the same; 4 cuts more of blinks.
"""

NOISE_AT_FIRST, NOISE_LEAST = 0.015, 0.004
"""Standard deviations of the noise: what 1 px of jitter at 100 px between the outer eyes makes of most weights, until
they are measured; and a least one, as shapes at rest are cut off at 0 and show none.
"""

_NOISE_RATE = 0.05
"""Share by which the noise's median rises or falls a frame: it doubles in a second of 30 frames. The same share of a
second at each rate is worse by 0.007 of r at 60 and 120 frames a second.
"""

_LATE_S = 0.0099
"""By which a frame may come later than a filter looks ahead, and be waited for: so one of 33 ms waits for the next of a
film of 23.976 frames a second. No usual rate's frames lie so far apart, so rounding decides nowhere.
"""

LIDS = tuple(f"{stem}{side.title()}" for side in SIDES for stem in ("eyeBlink", "eyeWide", "eyeSquint"))
"""Shapes of the lids."""

_LID_COLUMNS = [BLENDSHAPE_INDEX[name] for name in LIDS]


class NoiseMeter:
    """Median size of what changes from frame to frame and back, by column: noise, as faces do not tremble.

    The second difference of three frames takes off what moves evenly; its median is not moved by blinks.

    Parameters
    ----------
    columns
        How many.
    """

    def __init__(self, columns: int) -> None:
        self.noise = np.full(columns, NOISE_AT_FIRST)
        self._last: deque[np.ndarray] = deque(maxlen=2)

    def step(self, row: np.ndarray) -> np.ndarray:
        """Standard deviation (k,) of the noise after a row (k,).

        A row that repeats the one before says nothing: dim webcams give each picture twice.
        """
        if self._last and np.array_equal(row, self._last[-1]):
            return self.noise
        if len(self._last) == 2:
            size = np.abs(row - 2 * self._last[1] + self._last[0])
            rising = size > SECOND_DIFFERENCE * self.noise
            factor = np.exp(np.where(rising, _NOISE_RATE / 2, -_NOISE_RATE / 2))
            self.noise = np.maximum(self.noise * factor, NOISE_LEAST)
        self._last.append(row)
        return self.noise

    def forget(self) -> None:
        """Compare no later row with those so far; the noise is kept."""
        self._last.clear()


@dataclass(frozen=True, kw_only=True, eq=False)
class _Estimate:
    """What is known of a frame's row from the frames up to it: means and variances (k,), and those before the row."""

    mean: np.ndarray
    variance: np.ndarray
    foreseen: np.ndarray


class KalmanSmoothing(DelayingStage):
    """Kalman filter over weights and gaze: each wanders, faster where it surprises; seen with its own noise.

    Frames wait for those of the next ``ahead_s`` seconds, which correct them (the smoother of Rauch, Tung and
    Striebel), as long as the next is to be expected by then; so where frames are further apart, none waits.

    Parameters
    ----------
    ahead_s
        Seconds; 0 gives each sample at once.
    noise : (k,) float64, optional
        Standard deviations of weights and gaze from frame to frame; measured on the way by default.
    lids_ahead_s
        Seconds of these by which lids are corrected; as far as all else by default.
    """

    def __init__(
        self, ahead_s: float, noise: np.ndarray | None = None, lids_ahead_s: float | None = None
    ) -> None:
        self._until_s, self._noise = _until(ahead_s), noise
        self._lids_until_s = self._until_s if lids_ahead_s is None else _until(lids_ahead_s)
        self._meter: NoiseMeter | None = None
        self._time = -np.inf
        self._interval_s = np.inf
        self._waiting: deque[tuple[Sample, _Estimate | None]] = deque()
        self._last: _Estimate | None = None

    def feed(self, sample: Sample) -> list[Sample]:
        """Samples that have waited long enough, with filtered weights and gaze; those without weights as they are.

        Raises
        ------
        InputError
            Where a frame with weights has no time, or one no later than the frame before by up to `LONGEST_GAP_S`; the
            message has its label.
        """
        row = joined(sample)
        if np.isnan(row).any():
            self._waiting.append((sample, None))
            return self._ready(self._supposed(sample.time_s))
        if sample.time_s is None or not np.isfinite(sample.time_s):
            raise InputError(f"frame {sample.label} has no time, which a Kalman filter needs")
        seconds = sample.time_s - self._time
        afresh = abs(seconds) > LONGEST_GAP_S  # also by a clock that was set back
        if not (seconds > 0 or afresh):
            raise InputError(
                f"frame {sample.label}: time goes from {self._time:g} s to {sample.time_s:g} s; frames must be in order"
            )
        before = self.finish() if afresh else []
        self._time, self._interval_s = sample.time_s, abs(seconds)
        self._last = self._estimate(row, self._interval_s)
        self._waiting.append((sample, self._last))
        return before + self._ready(sample.time_s)

    def _supposed(self, time_s: float | None) -> float:
        """When a frame without weights was, also by a clock that began anew, or by none."""
        if time_s is not None and time_s > self._time:
            return time_s
        lost = 0
        for _, estimate in reversed(self._waiting):
            if estimate is not None:
                break
            lost += 1
        return self._time + lost * self._interval_s

    def finish(self) -> list[Sample]:
        """Samples that still wait, with what is known of them; the next one starts afresh."""
        held = [self._release() for _ in range(len(self._waiting))]
        self._last = None
        if self._meter is not None:
            self._meter.forget()
        return held

    def _estimate(self, row: np.ndarray, seconds: float) -> _Estimate:
        if self._meter is None:
            self._meter = NoiseMeter(len(row))
        noise = self._meter.step(row) if self._noise is None else self._noise
        seen = noise**2
        if self._last is None:
            return _Estimate(mean=row, variance=seen, foreseen=seen)
        surprise = row - self._last.mean
        foreseen = self._last.variance + WANDERING * seconds * seen
        foreseen = foreseen + np.maximum((surprise / SURPRISE) ** 2 - foreseen - seen, 0)
        share = foreseen / (foreseen + seen)
        mean = self._last.mean + share * surprise
        return _Estimate(mean=mean, variance=(1 - share) * foreseen, foreseen=foreseen)

    def _ready(self, time_s: float) -> list[Sample]:
        """Samples that need not wait any longer at a time; one without weights waits for those before it only."""
        next_s = time_s + self._interval_s
        ready = []
        while self._waiting and (
            self._waiting[0][1] is None or next_s - self._waiting[0][0].time_s > self._until_s
        ):
            ready.append(self._release())
        return ready

    def _release(self) -> Sample:
        """The first of those that wait, corrected by all behind it."""
        known = [(other.time_s, estimate) for other, estimate in self._waiting if estimate is not None]
        sample, own = self._waiting.popleft()
        if own is None:
            return sample
        estimates = [estimate for _, estimate in known]
        mean = _corrected(estimates)
        if self._lids_until_s < self._until_s:
            soon = sum(time_s - sample.time_s <= self._lids_until_s for time_s, _ in known)
            mean[_LID_COLUMNS] = _corrected(estimates[:soon])[_LID_COLUMNS]
        return with_row(sample, mean)


def _until(ahead_s: float) -> float:
    """Seconds behind a frame until which later ones are waited for."""
    return ahead_s + _LATE_S if ahead_s > 0 else 0.0


def _corrected(estimates: list[_Estimate]) -> np.ndarray:
    """Mean (k,) of the first frame's row, known from all of them; a new array."""
    mean = estimates[-1].mean.copy()
    for estimate, after in zip(estimates[-2::-1], estimates[:0:-1], strict=True):
        mean = estimate.mean + estimate.variance / after.foreseen * (mean - estimate.mean)
    return mean
