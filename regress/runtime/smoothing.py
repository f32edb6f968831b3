"""Smoothing over time: the paper's moving average, and One-Euro by real timestamps, of weights or landmarks."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.features import align_similarity
from regress.targets import NETWORKS

LONGEST_GAP_S = 0.5
"""Seconds without a face after which smoothing starts afresh: what was before says nothing any more."""


@dataclass(frozen=True, kw_only=True)
class OneEuro:
    """Settings of a One-Euro filter (G. Casiez, N. Roussel, D. Vogel, CHI 2012).

    Parameters
    ----------
    cutoff_hz
        Of a weight at rest: lower is calmer.
    beta
        Hz more for each unit of weight a second: higher follows quick moves sooner.
    speed_cutoff_hz
        Of the speed's own low pass.
    """

    cutoff_hz: float = 1.0
    beta: float = 2.0
    speed_cutoff_hz: float = 1.0


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


class OneEuroStream:
    """One-Euro over rows of weights as they come.

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
        """Smoothed weights (k,) at a time later than the last; rows of NaN pass through."""
        if np.isnan(weights).any():
            return weights
        if self._time is None or time_s - self._time > LONGEST_GAP_S:
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
faces (docs/real-recordings.md): 5 cuts blinks to 0.83 of their height, 20 leaves a fifth more jitter.
"""


class LandmarkStream:
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
        self._filter = OneEuroStream(settings, np.full(2 * LANDMARK_COUNT, cutoff_hz))
        self._mean_shape = mean_shape

    def step(self, time_s: float, points: np.ndarray) -> np.ndarray:
        """Smoothed face (68, 2) in face widths at a time later than the last; NaN where points are missing."""
        laid = align_similarity(points[None], self._mean_shape).reshape(-1)
        return self._filter.step(time_s, laid).reshape(LANDMARK_COUNT, 2)


def smooth_landmarks(
    points: np.ndarray, time_s: np.ndarray, cutoff_hz: float, mean_shape: np.ndarray
) -> np.ndarray:
    """Faces (n, 68, 2) smoothed by `LandmarkStream`, in face widths; rows of NaN stay NaN."""
    stream = LandmarkStream(cutoff_hz, mean_shape)
    return np.array([stream.step(float(time), face) for time, face in zip(time_s, points, strict=True)])


def one_euro(weights: np.ndarray, time_s: np.ndarray, settings: OneEuro) -> np.ndarray:
    """Rows (n, 52) smoothed by One-Euro; rows of NaN stay NaN.

    Raises
    ------
    InputError
        Where the time of a row with weights is missing or no later than the one before; the message has its number.
    """
    stream = OneEuroStream(settings)
    rows = []
    for number, (time, row) in enumerate(zip(time_s, weights, strict=True), start=1):
        if not (np.isfinite(time) or np.isnan(row).any()):
            raise InputError(f"row {number} has no time, which One-Euro smoothing needs")
        try:
            rows.append(stream.step(float(time), row))
        except InputError as error:
            raise InputError(f"row {number}: {error}") from error
    return np.array(rows)


def moving_average(weights: np.ndarray, frames: int) -> np.ndarray:
    """Mean of each row and those before it, ``frames`` in all, fewer at the start: what a live stream has.

    Rows of NaN stay NaN, and other rows' means leave them out.

    Parameters
    ----------
    weights : (n, k) float64
    frames
        1 or more.
    """
    if frames <= 1:
        return weights
    known = ~np.isnan(weights)
    sums = np.cumsum(np.where(known, weights, 0), axis=0)
    counts = np.cumsum(known, axis=0)
    sums[frames:] -= sums[:-frames].copy()
    counts[frames:] -= counts[:-frames].copy()
    # The running sum leaves rounding of 1e-16 a frame behind: back into the range that its terms had.
    mean = np.clip(sums / np.maximum(counts, 1), 0, 1)
    return np.where(known, mean, np.nan)


def _share(cutoff_hz: float | np.ndarray, seconds: float) -> float | np.ndarray:
    """How much of a new value a first-order low pass takes."""
    turn = 2 * np.pi * seconds * cutoff_hz
    return turn / (turn + 1)
