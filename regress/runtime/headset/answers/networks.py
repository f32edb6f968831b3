"""From a headset's pictures to weights, gaze and confidence, frame by frame."""

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.errors import InputError
from regress.runtime.headset.answers.confidence import HeadsetConfidence
from regress.runtime.headset.answers.eye_reader import EyeReader
from regress.runtime.headset.answers.partly import partly_compared
from regress.runtime.headset.network.estimates import Estimates
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.network.temporal import TAPS
from regress.runtime.headset.person.person import OwnEnds, Person
from regress.runtime.headset.person.seats import SeatWatch
from regress.runtime.headset.placing.levels import Levels
from regress.runtime.sample import NO_EYES, Sample
from regress.runtime.stages.frame_clock import USUAL_FPS, FrameClock
from regress.runtime.stages.gaze import LOOKS, look_weights
from regress.runtime.stages.smoothing import Pauses
from regress.runtime.stages.stage import Stage


class HeadsetNetworks(Stage):
    """Runs the network on each frame, calibrated as long as the headset stays in the seat of the neutral pictures.

    Parameters
    ----------
    predictor
        The model.
    fps
        Frames a second of samples without times.
    keep_neutral
        Stay calibrated after a change of seat: another seat's neutral picture of the same person is worth more than
        none, another person's is not. Cameras without a neutral picture then leave the others theirs.
    levels
        Levels pictures as they come, and neutral ones alike; None takes both as they are.
    reader
        Measures the eyes and sets the gaze; without, nothing is measured, and the gaze is the network's own as long as
        no camera is so unlike the training's that traced points lead (``regress.runtime.headset.eyes.gaze_lead``).
    still
        Whether frames are of many people, of whom nothing can be learnt from one to the next.
    person
        Whose own ends count, with a reader.
    take
        Whether frames are of a take, all of which come before an answer counts: `led_take` says whose gaze leads.
    """

    def __init__(
        self,
        predictor: HeadsetPredictor,
        *,
        fps: float = USUAL_FPS,
        keep_neutral: bool = False,
        levels: Levels | None = None,
        reader: EyeReader | None = None,
        still: bool = False,
        person: Person | None = None,
        take: bool = False,
    ) -> None:
        self._seen: list[tuple[float, dict[str, np.ndarray]]] | None = [] if take else None
        self._predictor, self._clock, self._keep = predictor, FrameClock(fps), keep_neutral
        self._levels = levels
        self._reader = reader
        self._leader = EyeReader(predictor) if reader is None and not still else None
        self._points: Mapping[str, np.ndarray] = {}
        self._ends = None if person is None or reader is None else OwnEnds.of(person, reader.sides)
        scored = predictor.model.scores is not None
        self._confidence = HeadsetConfidence(predictor.model) if scored else None
        self._neutral: Mapping[str, np.ndarray] | None = None
        self._seat: SeatWatch | None = None
        self._doubted_from: str | None = None
        self.reseated: list[str] = []
        """Labels of the frames from which the seat was no longer that of the neutral pictures."""

    @property
    def traced(self) -> dict[str, np.ndarray]:
        """Pixels (P, 2) of the points of the last frame, by camera; of still frames with a reader alone."""
        return {name: points[0] for name, points in self._points.items()}

    def use_neutral(self, pictures: Mapping[str, np.ndarray] | None) -> None:
        """Compare frames with neutral pictures (h, w) uint8 of the network's sizes from now on; None: with none."""
        self._neutral = pictures
        self._seat = None if pictures is None else SeatWatch()
        self._doubted_from = None

    def step(self, sample: Sample) -> Sample:
        """The sample with weights (52,) in [0, 1], gaze (4,) and, for a model with scores, confidence (52,).

        Raises
        ------
        InputError
            Where a camera is not the model's, or has no neutral picture while others have and ``keep_neutral`` is not
            set.
        """
        if not sample.pictures:
            nothing = np.full(len(BLENDSHAPES), np.nan)
            trust = None if self._confidence is None else np.zeros(len(BLENDSHAPES))
            eyes = None if self._reader is None else NO_EYES
            return replace(sample, weights=nothing, gaze=np.full(4, np.nan), eyes=eyes, confidence=trust)
        seconds = self._clock.step(sample.time_s)
        seen = sample
        if self._levels is not None:
            seen = replace(sample, pictures=self._levels.step(seconds, sample.pictures))
        estimates, calibrated = self._estimate(seen, seconds)
        trust = None
        if self._confidence is not None:
            present = np.array([name in sample.pictures for name in self._predictor.sizes])
            trust = self._confidence.of_frame(estimates.deviation[0], present, calibrated=calibrated)
        answer = replace(
            sample,
            weights=np.clip(estimates.weights[0].astype(np.float64), 0, 1),
            gaze=estimates.gaze[0].astype(np.float64).reshape(4),
            confidence=trust,
        )
        if self._reader is not None:
            return self._with_eyes(answer, seen.pictures, seconds)
        if self._leader is None:
            return answer
        if self._seen is not None:
            self._seen.append(
                (seconds, {name: self.traced[name] for name in self._leader.sides if name in self.traced})
            )
            return answer
        return self._led(answer, seconds, self.traced)

    def led_take(self, samples: Sequence[Sample]) -> list[Sample]:
        """Answers of all frames of a take, with the gaze of traced points as far as they lead over all of it."""
        if self._leader is None or not self._seen:
            return list(samples)
        shown = iter(self._seen)
        frames = [(sample, next(shown) if sample.pictures else None) for sample in samples]
        for sample, seen in frames:
            if seen is not None:
                self._leader.led(*seen, sample.gaze)
        self._seen = []
        return [sample if seen is None else self._led(sample, *seen) for sample, seen in frames]

    def compared(self, pictures: Mapping[str, np.ndarray]) -> np.ndarray:
        """Weights (n, 52) of frames of before, (n, h, w) uint8 by camera, compared with the neutral pictures in use.

        Nothing is learnt of them: neither levels nor seat.
        """
        seen, neutral = pictures, self._neutral
        if self._levels is not None:
            seen, neutral = self._levels.levelled(pictures), self._levels.levelled(neutral or {}) or None
        weights = self._predictor.predict(seen, neutral=neutral).weights
        return np.clip(weights.astype(np.float64), 0, 1)

    def _with_eyes(self, sample: Sample, pictures: Mapping[str, np.ndarray], seconds: float) -> Sample:
        """The sample with its eyes measured, a gaze that meets in front, and the person's own ends."""
        eyes, gaze = self._reader.read(seconds, pictures, self.traced, sample.gaze)
        weights = sample.weights if self._ends is None else self._ends.apply(sample.weights, eyes)
        weights = weights.copy()
        weights[LOOKS] = look_weights(gaze)
        return replace(sample, weights=weights, gaze=gaze, eyes=eyes)

    def _led(self, sample: Sample, seconds: float, traced: Mapping[str, np.ndarray]) -> Sample:
        """The sample with the gaze of traced points, as far as they lead."""
        gaze, share = self._leader.led(seconds, traced, sample.gaze)
        if not share:
            return sample
        weights = sample.weights.copy()
        weights[LOOKS] += share * (look_weights(gaze) - weights[LOOKS])
        return replace(sample, weights=weights, gaze=gaze)

    def _estimate(self, sample: Sample, seconds: float) -> tuple[Estimates, bool]:
        """What the network says, and whether it compared the frame with neutral pictures."""
        pictures = {name: picture[None] for name, picture in sample.pictures.items()}
        if self._seat is None:
            return self._see(pictures), False
        if self._seat.changed and not self._keep:
            return self._see(pictures, neutral=self._neutral, calibrated=np.zeros(1)), False
        neutral = self._neutral if self._levels is None else self._levels.levelled(self._neutral)
        known = [name for name in pictures if name in neutral]
        whole = len(known) == len(pictures) or not self._keep
        if not (known or whole):
            return self._see(pictures), False
        estimates = (
            self._see(pictures, neutral=neutral) if whole else self._see_partly(pictures, known, neutral)
        )
        if not self._seat.changed:
            compared = self._seat.step(seconds, float(estimates.same_seat[0]))
            self._doubted_from = None if compared else self._doubted_from or sample.label
            if self._seat.changed:
                self.reseated.append(self._doubted_from)
            if not (compared or self._keep):
                return self._see(pictures, neutral=self._neutral, calibrated=np.zeros(1)), False
        return estimates, whole

    def _see_partly(
        self, pictures: Mapping[str, np.ndarray], known: Sequence[str], neutral: Mapping[str, np.ndarray]
    ) -> Estimates:
        """Estimates where only the ``known`` cameras have neutral pictures."""
        compared = self._predictor.predict({name: pictures[name] for name in known}, neutral=neutral)
        lost = [name for name in pictures if name not in known]
        return partly_compared(compared, self._see(pictures), known=known, lost=lost)

    def _see(self, pictures: Mapping[str, np.ndarray], **neutral: object) -> Estimates:
        """Estimates; what is traced is kept, where anybody goes by it."""
        if self._reader is None and self._leader is None:
            return self._predictor.predict(pictures, **neutral)
        estimates, self._points = self._predictor.see(pictures, **neutral)
        return estimates


class TemporalConvolution(Stage):
    """Weights and gaze as the model's taps weigh them and those of the four frames before.

    Parameters
    ----------
    predictor
        Whose model has taps.

    Raises
    ------
    InputError
        Where it has none.
    """

    def __init__(self, predictor: HeadsetPredictor) -> None:
        temporal = predictor.model.temporal
        if temporal is None:
            raise InputError(
                "the model does not know what the frames before are worth; `regress headset temporal` finds it on clips"
            )
        self._taps = np.array(temporal.taps)
        self._recent: deque[np.ndarray] = deque(maxlen=TAPS)
        self._pauses = Pauses()

    def step(self, sample: Sample) -> Sample:
        """The sample with convolved weights and gaze; a pause or a sample without pictures ends what is remembered."""
        if self._pauses.before(sample.time_s):
            self._recent.clear()
        if np.isnan(sample.weights).any():
            self._recent.clear()
            return sample
        row = np.concatenate([sample.weights, sample.gaze])
        self._recent.appendleft(row)
        # before a take's first frame there is nothing, and the first stands in for it
        history = [*self._recent, *[self._recent[-1]] * (TAPS - len(self._recent))]
        values = np.einsum("lk,kl->k", np.array(history), self._taps)
        columns = len(sample.weights)
        return replace(sample, weights=np.clip(values[:columns], 0, 1), gaze=values[columns:])
