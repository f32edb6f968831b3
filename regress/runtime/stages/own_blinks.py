"""Stretches eyeBlink by the person's own blinks: the fullest of them reads 1.

A network of rendered people tells a real shut eye from an open one, and reads it as half shut (docs/your-camera.md).
People blink ten to twenty times a minute, so nobody has to be asked: a blink goes up and down within half a second, and
nothing else of a lid does. A squint, a look down and a smile stay, and count for nothing here.
"""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar

import numpy as np
from annotated_types import Interval

from facegen.conventions import BLINK_INDICES
from regress.runtime.frame_noise import SECOND_DIFFERENCE
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import DelayingStage, Stage

SIDE_S = 0.4
"""Before and after its peak, within which a blink has begun and is over: blinks take 0.1 to 0.4 s (docs/motion.md)."""

LEAST_RISE, _RISE_NOISES, _RISE_OF_ANY = 0.15, 8.0, 0.02
"""Of a reading, from an open eye to the peak: less is noise, or a network that sees no lids. Where readings have little
noise, so many standard deviations of it are enough, down to the last: a detector may hardly close lids, and be sure."""

FEWEST = 8
"""Blinks that must have been seen. Many are not full: at ten starts in a recorded speech the fullest of the first five
was .54 to .96, of the first eight .94 to .96 (a probe)."""

REMEMBERED = 40
"""Blinks that count while frames come, some two minutes: a headset slips, and a hand before the eye is forgotten."""

_ONE_IN = 40
"""Blinks of which one may be none, as of an eye that was rubbed. Of fewer the fullest counts: by the fullest but one of
the twenty of a recorded speech the error at blinks was .096, and .053 by the fullest."""

_BESIDE_S, _BESIDE = 0.04, 0.25
"""Seconds next to a blink's peak in which a lid still has more than such a share of the way to go: lids take longer to
open. What is back by then on both sides is a glitch of the detector."""

OPEN = 0.1
"""Reading up to which any eye counts as open, and nothing is stretched: its noise stays what it was. An eye that reads
more between its blinks counts as open up to there."""

_OPEN_NOISES, _OPEN_OF_ANY = 4.0, 0.01
"""The same of an eye with little noise, and no less."""

MOST, UTMOST, _STRETCHED_NOISE = 3.0, 10.0, 0.06
"""Factor on what is above an open eye, at most; beyond it half-shut and shut eyes read alike. With little noise it may
be up to the second, as long as noise is stretched to no more than the third."""

_JUMPS, _FEWEST_JUMPS = 900, 30
"""Second differences of an eye's readings of which the median tells its noise, half a minute; none is told by fewer."""

TOLD_FROM = 1.2
"""Factor from which a person is told."""

Reading = Annotated[float, Interval(ge=0, le=1)]


@dataclass(frozen=True, kw_only=True)
class Ends:
    """What an eye reads between blinks and at a full one.

    Parameters
    ----------
    open
        From here on readings are stretched.
    full
        What becomes 1, as far as ``most`` goes.
    most
        Factor at most: `MOST`, and more by little noise.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}

    open: Reading
    full: Reading
    most: Annotated[float, Interval(ge=1, le=UTMOST)] = MOST

    @property
    def factor(self) -> float:
        """On what is above ``open``."""
        return float(np.clip((1 - self.open) / max(self.full - self.open, 1e-9), 1.0, self.most))

    def stretched(self, reading: float) -> float:
        """A reading in [0, 1]; NaN stays."""
        if not reading > self.open or self.factor == 1:
            return reading
        return min(1.0, self.open + (reading - self.open) * self.factor)


WHOLE = Ends(open=OPEN, full=1.0)
"""Of an eye of which nothing is known: readings stay."""


class BlinkWatch:
    """Finds the blinks of one eye among readings as they come.

    Parameters
    ----------
    before
        What is known of the eye from another day.
    remembered
        Blinks that count; None for all.

    Attributes
    ----------
    peaks, feet
        Readings of the last blinks at their fullest, and beside them.
    ends
        The person's own; ``before`` while too few blinks were seen.
    """

    def __init__(self, before: Ends = WHOLE, *, remembered: int | None = REMEMBERED) -> None:
        self.peaks: deque[float] = deque(maxlen=remembered)
        self.feet: deque[float] = deque(maxlen=remembered)
        self.ends = before
        self._times: deque[float] = deque()
        self._readings: deque[float] = deque()
        self._jumps: deque[float] = deque(maxlen=_JUMPS)
        self._judged_s = -np.inf

    def step(self, time_s: float, reading: float) -> bool:
        """Take a reading; whether a blink ended with it. One of NaN, or of no later time, ends what was before."""
        if not np.isfinite(reading) or (self._times and not time_s > self._times[-1]):
            self._times.clear()
            self._readings.clear()
            self._judged_s = -np.inf
            return False
        self._times.append(time_s)
        self._readings.append(reading)
        if len(self._readings) > 2:
            self._jumps.append(abs(self._readings[-3] - 2 * self._readings[-2] + reading))
        while self._times[0] < time_s - 2 * SIDE_S:
            self._times.popleft()
            self._readings.popleft()
        return self._judge(time_s - SIDE_S)

    def _judge(self, until_s: float) -> bool:
        """Look at readings that have all of a side behind them, each once."""
        times, readings = np.array(self._times), np.array(self._readings)
        due = np.flatnonzero((times > self._judged_s) & (times <= until_s))
        for row in due:
            self._judged_s = times[row]
            before = readings[: row + 1][times[: row + 1] >= times[row] - SIDE_S]
            after = readings[row:][times[row:] <= times[row] + SIDE_S]
            if _is_blink(before, after) and self._counts(times, row, _foot(before, after)):
                self.peaks.append(float(readings[row]))
                self.feet.append(_foot(before, after))
                if len(self.peaks) >= FEWEST:
                    self.ends = self._found()
                return True
        return False

    def _counts(self, times: np.ndarray, row: int, foot: float) -> bool:
        """Whether a blink is more than this eye's noise, and no glitch."""
        readings = np.array(self._readings)
        if readings[row] - foot < self._by_noise(_RISE_NOISES, _RISE_OF_ANY, LEAST_RISE):
            return False
        return not _is_spike(times, readings, row, foot)

    def _found(self) -> Ends:
        opened = max(self._by_noise(_OPEN_NOISES, _OPEN_OF_ANY, OPEN), float(np.median(self.feet)))
        most = float(np.clip(_STRETCHED_NOISE / max(self._noise, 1e-9), MOST, UTMOST))
        return Ends(open=opened, full=_fullest(self.peaks), most=most)

    def _by_noise(self, noises: float, least: float, most: float) -> float:
        """So many standard deviations of the eye's noise, between two readings."""
        return float(np.clip(noises * self._noise, least, most))

    @property
    def _noise(self) -> float:
        """Standard deviation of a reading (`regress.runtime.frame_noise`); much, while few are seen."""
        return np.inf if len(self._jumps) < _FEWEST_JUMPS else np.median(self._jumps) / SECOND_DIFFERENCE


def _is_spike(times: np.ndarray, readings: np.ndarray, row: int, foot: float) -> bool:
    """Whether readings are back at once on both sides of a peak; of few frames a second nobody can tell."""
    beside = [row - 1, row + 1]
    quick = (np.abs(times[beside] - times[row]) < _BESIDE_S).all()
    return bool(quick and readings[beside].max() < foot + _BESIDE * (readings[row] - foot))


def _foot(before: np.ndarray, after: np.ndarray) -> float:
    return float(max(before.min(), after.min()))


def _fullest(peaks: Sequence[float]) -> float:
    """The fullest reading below those that may be of no blink."""
    return sorted(peaks)[-1 - len(peaks) // _ONE_IN]


def _is_blink(before: np.ndarray, after: np.ndarray) -> bool:
    """Whether readings rise to the last of the first and the first of the second, and fall again."""
    peak, foot = before[-1], _foot(before, after)
    first = bool((before[:-1] < peak).all() and (after <= peak).all())
    return first and peak - foot >= _RISE_OF_ANY and foot <= peak / 2


class OwnBlinks(Stage):
    """Blinks as they come: each frame by those before it.

    Parameters
    ----------
    say
        Told once, when blinks are stretched by so much that it shows.
    before
        What is known of both eyes from another day, the left one first: stretches blinks until enough of today's are
        seen.

    Attributes
    ----------
    known : (2,) bool
        Of which eyes a full blink's reading is known otherwise, the left one first: these stay as they are. May be
        changed between two frames.
    unseen : (2,) bool
        Which eyes no camera sees in the next frame: what is read of them is guessed, and no blink is learnt from it.
    """

    def __init__(
        self,
        say: Callable[[str], None] = lambda message: None,
        *,
        before: tuple[Ends, Ends] = (WHOLE, WHOLE),
    ) -> None:
        self._say, self._told = say, False
        self.known, self.unseen = np.zeros((2, 2), dtype=bool)
        self._eyes = tuple(BlinkWatch(ends) for ends in before)

    def forget(self) -> None:
        """Begin anew: blinks before another neutral face, or another seat, read otherwise."""
        self._eyes = (BlinkWatch(), BlinkWatch())

    @property
    def ends(self) -> tuple[Ends, ...]:
        """Of both eyes, the left one first; `WHOLE` of one whose full blink is known otherwise, or not yet."""
        return tuple(WHOLE if known else eye.ends for known, eye in zip(self.known, self._eyes, strict=True))

    def step(self, sample: Sample) -> Sample:
        """The sample with stretched eyeBlinks; one without a time or weights as it is."""
        if sample.weights is None or sample.time_s is None or not np.isfinite(sample.time_s):
            return sample
        read = np.where(self.unseen, np.nan, sample.weights[BLINK_INDICES])
        ended = [eye.step(sample.time_s, float(blink)) for blink, eye in zip(read, self._eyes, strict=True)]
        ends = self.ends
        if any(ended) and not self._told and max(own.factor for own in ends) >= TOLD_FROM:
            self._told = True
            self._say(told_of(ends))
        return _with_blinks(sample, ends)


class TakeBlinks(DelayingStage):
    """Blinks of a whole take: its first frame is stretched by what its last one showed.

    Parameters
    ----------
    say
        Told at the end what was found.
    few_told
        Also where too few blinks were seen, or they are full as they are read.
    """

    def __init__(self, say: Callable[[str], None] = lambda message: None, *, few_told: bool = True) -> None:
        self._say, self._few_told = say, few_told
        self._eyes = (BlinkWatch(remembered=None), BlinkWatch(remembered=None))
        self._held: list[Sample] = []

    def feed(self, sample: Sample) -> list[Sample]:
        """Nothing yet."""
        self._held.append(sample)
        if sample.weights is not None and sample.time_s is not None:
            for column, eye in zip(BLINK_INDICES, self._eyes, strict=True):
                eye.step(sample.time_s, sample.weights[column])
        return []

    def finish(self) -> list[Sample]:
        """All samples."""
        ends = [eye.ends for eye in self._eyes]
        seen = max(len(eye.peaks) for eye in self._eyes)
        if self._few_told or max(own.factor for own in ends) >= TOLD_FROM:
            self._say(told_of(ends) if seen >= FEWEST else _too_few(seen))
        held, self._held = self._held, []
        return [_with_blinks(sample, ends) for sample in held]


def _with_blinks(sample: Sample, ends: Sequence[Ends]) -> Sample:
    if sample.weights is None:
        return sample
    weights = sample.weights.copy()
    weights[BLINK_INDICES] = [
        own.stretched(weights[column]) for column, own in zip(BLINK_INDICES, ends, strict=True)
    ]
    return replace(sample, weights=weights)


def told_of(ends: Sequence[Ends]) -> str:
    """What was found of both eyes, in a sentence."""
    left, right = (f"{own.full:.2f}" for own in ends)
    return f"the fullest blinks read {left} (left) and {right} (right), and are stretched towards 1"


def _too_few(seen: int) -> str:
    return f"fewer than {FEWEST} blinks were seen ({seen}), so they stay as they are read"
