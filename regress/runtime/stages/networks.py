"""From landmarks to weights: the networks, and a neutral face that is looked for while frames come."""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from regress.errors import InputError
from regress.runtime.model import Model
from regress.runtime.sample import Sample
from regress.runtime.stages.confidence import confidence
from regress.runtime.stages.frame_clock import FrameClock
from regress.runtime.stages.neutral import SHARES, estimate_neutral, frame_rate
from regress.runtime.stages.stage import BatchStage, Stage

SURE_FROM_S = 10.0
"""Seconds of a face before which nothing is sure. Those two seconds long look sure of many a wrong face: of a recorded
range of motion the worst minute had an error of .114 behind them, and .091 behind ten seconds (without: .083)."""

TELL_AT_S = SURE_FROM_S
"""After which a person is told once that nothing was found so far, and why."""

ESTIMATE_EVERY_S, ESTIMATE_LATER_S = 1.0, 5.0
"""Between two estimates of the neutral face; the longer once a person was told: one of half a minute takes .1 s."""

SURE_TIMES = 2
"""Estimates in a row that must be sure: of people who talk all the time one in ten passes once, in the short run."""

AGAIN_AT_S = (20.0, 30.0, 60.0)
"""Seconds of a face at which a found one is replaced, if the estimate is sure then: who talked at first rests later."""

FORGOTTEN_S = 2.0
"""Without a face for this long, all begins anew: somebody else may sit down (as `track.detectors.following` has it)."""

_KEPT_EVERY_S, _REMEMBERED = 0.025, 900
"""Frames are kept no oftener; an estimate looks back on so many, 22 seconds or more, half a minute of most cameras."""

_ROUNDING_S = 1e-6


class LandmarkNetworks(BatchStage):
    """Weights of each frame's landmarks by a model.

    Parameters
    ----------
    model
        Calibrated where a neutral face is known.
    """

    def __init__(self, model: Model) -> None:
        self.model = model

    def use_model(self, model: Model) -> None:
        """Predict with another model from the next frame on."""
        self.model = model

    def batch(self, samples: Sequence[Sample]) -> list[Sample]:
        """Samples with weights (52,), NaN where a point is missing; those of many frames differ by 5e-15 at most."""
        weights = self.model.predict(np.stack([sample.points for sample in samples]))
        return [replace(sample, weights=row) for sample, row in zip(samples, weights, strict=True)]


class LandmarkConfidence(BatchStage):
    """Trust in each weight of a frame, by its landmarks as the detector gave them.

    Parameters
    ----------
    networks
        Those that predict, by the model that they have at each frame: it may be calibrated on the way.
    """

    def __init__(self, networks: LandmarkNetworks) -> None:
        self._networks = networks

    def batch(self, samples: Sequence[Sample]) -> list[Sample]:
        """Samples with confidence (52,)."""
        trust = confidence(self._networks.model, np.stack([sample.points for sample in samples]))
        return [replace(sample, confidence=row) for sample, row in zip(samples, trust, strict=True)]


class AutomaticCalibration(Stage):
    """Looks for the neutral face while frames come, and calibrates the networks once it is sure.

    A found face is replaced by those of `AGAIN_AT_S`, and put away where the face was away.

    Parameters
    ----------
    networks
        Serve without a neutral frame until one is found.
    say
        Told when it is sure, and why; and once where it takes long.

    Attributes
    ----------
    neutral : (m, 68, 2) float64
        The calm frames that are in use; None before. Each find is another array.

    Raises
    ------
    InputError
        Where the model has no calibrated networks.
    """

    def __init__(self, networks: LandmarkNetworks, say: Callable[[str], None]) -> None:
        if networks.model.calibrated is None:
            raise InputError("the model has no calibrated networks, so a neutral frame is of no use to it")
        self._networks, self._plain = networks, networks.model
        self._say = say
        self._clock = FrameClock()
        self._begin()

    def _begin(self) -> None:
        self.neutral: np.ndarray | None = None
        self._recent: deque[tuple[float, np.ndarray]] = deque(maxlen=_REMEMBERED)
        self._seen_s = self._away_s = self._kept_s = 0.0
        self._due_s = SURE_FROM_S - (SURE_TIMES - 1) * ESTIMATE_EVERY_S
        self._sure, self._told = 0, False

    def step(self, sample: Sample) -> Sample:
        """Take a frame into account; of one with missing points only that no face was there."""
        lasts_s = self._clock.step(sample.time_s)
        if not np.isfinite(sample.points).all():
            self._away_s += lasts_s
            return sample
        if self._away_s > FORGOTTEN_S - _ROUNDING_S:
            self._forget(sample.label)
        self._away_s = 0.0
        self._seen_s += lasts_s
        if self._due_s < np.inf and self._seen_s > self._kept_s + _KEPT_EVERY_S - _ROUNDING_S:
            self._recent.append((np.nan if sample.time_s is None else sample.time_s, sample.points))
            self._kept_s = self._seen_s
        if self._seen_s > self._due_s - _ROUNDING_S:
            self._estimate(sample.label)
        return sample

    def _forget(self, label: str) -> None:
        if self.neutral is not None:
            self._networks.use_model(self._plain)
            self._say(f"frame {label}: a face is back; its neutral face is looked for anew")
        self._begin()

    def _estimate(self, label: str) -> None:
        times, points = (np.array(each) for each in zip(*self._recent, strict=True))
        # it looks again soon, and no frame should wait for several estimates
        estimate = estimate_neutral(self._plain, points, frame_rate(times), shares=SHARES[:1])
        self._sure = self._sure + 1 if estimate.sure else 0
        if self._sure >= SURE_TIMES or (self.neutral is not None and estimate.sure):
            first, self.neutral = self.neutral is None, points[estimate.frames]
            self._networks.use_model(self._plain.calibrate(self.neutral))
            if first:
                self._say(f"frame {label}: neutral face found ({estimate.reason}); calibrated from here on")
        elif self._seen_s > TELL_AT_S - _ROUNDING_S and self.neutral is None and not self._told:
            self._told = True
            self._say(f"frame {label}: no neutral face found so far ({estimate.reason}); looking on")
        self._due_s = self._next_s()

    def _next_s(self) -> float:
        """When the next estimate is due, in seconds of a face; never once all are made."""
        if self.neutral is not None:
            return min((at_s for at_s in AGAIN_AT_S if at_s > self._seen_s + _ROUNDING_S), default=np.inf)
        return self._seen_s + (ESTIMATE_LATER_S if self._told else ESTIMATE_EVERY_S)
