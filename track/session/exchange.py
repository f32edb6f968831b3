"""Whether a headset's cameras were exchanged while it is worn: each picture against what every camera showed lately."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from enum import Enum
from itertools import combinations

import cv2
import numpy as np

from regress.runtime.headset.typical import TYPICAL_SIDE
from regress.runtime.sample import Sample
from regress.runtime.stages.frame_clock import FrameClock
from regress.runtime.stages.stage import Stage

LATELY_S = 0.5
"""In which what a camera showed is forgotten, at any frame rate: two cameras whose pictures differ little would else be
learnt for each other before anybody is told."""

MARGIN = 0.15
"""Mean correlation by which two pictures must be liker each other's camera than their own; while they are exchanged
nothing more is asked for."""


class CameraFault(Enum):
    """What is wrong with a camera's place; the value says what it has."""

    EXCHANGED = "pictures that look like another camera's; are two exchanged?"


class ExchangeWatch(Stage):
    """Takes pictures away that look like another camera's; a camera is known from its first picture on.

    Cameras that are exchanged from the beginning are told by `UprightWatch` and `regress headset check`, not here.
    """

    def __init__(self) -> None:
        self._looks: dict[str, np.ndarray] = {}
        self._exchanged: set[str] = set()
        self._clock = FrameClock()

    def step(self, sample: Sample) -> Sample:
        """The sample without exchanged pictures; ``faults`` names their cameras."""
        learnt = 1 - math.exp(-self._clock.step(sample.time_s) / LATELY_S)
        seen = {name: _standard(_small(picture)) for name, picture in (sample.pictures or {}).items()}
        before, self._exchanged = self._exchanged, set()
        known = [name for name in seen if name in self._looks]
        likeness = self._likeness(known, seen)
        for one, other in combinations(range(len(known)), 2):
            pair = {known[one], known[other]}
            margin = 0.0 if before.issuperset(pair) else MARGIN
            # by how much two pictures are liker each other's camera than their own
            crossed = (
                likeness[one][other] + likeness[other][one] - likeness[one][one] - likeness[other][other]
            )
            if crossed / 2 > margin:
                self._exchanged |= pair
        faults = dict.fromkeys(sorted(self._exchanged), CameraFault.EXCHANGED)
        if not faults:
            for name, look in seen.items():
                self._learn(name, look, learnt)
            return sample
        pictures = {name: picture for name, picture in sample.pictures.items() if name not in faults}
        return replace(sample, pictures=pictures, faults={**sample.faults, **faults})

    def _likeness(self, names: Sequence[str], seen: Mapping[str, np.ndarray]) -> list[list[float]]:
        """Correlation of each picture (a row) with what each camera showed lately."""
        if not names:
            return []
        return (
            np.array([seen[name] for name in names]) @ np.array([self._looks[name] for name in names]).T
        ).tolist()

    def _learn(self, name: str, look: np.ndarray, share: float) -> None:
        mixed = (1 - share) * self._looks.get(name, look) + share * look
        self._looks[name] = _normed(mixed)


def _small(picture: np.ndarray) -> np.ndarray:
    return cv2.resize(picture, (TYPICAL_SIDE, TYPICAL_SIDE), interpolation=cv2.INTER_AREA)


def _standard(picture: np.ndarray) -> np.ndarray:
    """Grey levels (576,) about their mean, of length 1; zeros of a picture of one level."""
    values = picture.astype(np.float32).ravel()
    return _normed(values - values.mean())


def _normed(values: np.ndarray) -> np.ndarray:
    return values / max(float(values @ values) ** 0.5, 1e-9)
