"""Whether a headset's cameras were exchanged while it is worn: each picture against what every camera showed lately."""

from collections.abc import Mapping
from dataclasses import replace
from enum import Enum
from itertools import combinations

import cv2
import numpy as np

from regress.runtime.headset.typical import TYPICAL_SIDE
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage

LEARNT = 0.02
"""Share of a new picture in what a camera showed lately: half a second at 120 frames a second."""

MARGIN = 0.15
"""Mean correlation by which two pictures must be liker each other's camera than their own; while they are exchanged
nothing more is asked for."""


class CameraFault(Enum):
    """What is wrong with a camera's place; the value says what it has."""

    EXCHANGED = "pictures that look like another camera's; are two exchanged?"


class ExchangeWatch(Stage):
    """Takes pictures away that look like another camera's; a camera is known from its first picture on.

    Cameras that are exchanged from the beginning are told by `regress headset check`, not here.
    """

    def __init__(self) -> None:
        self._looks: dict[str, np.ndarray] = {}
        self._exchanged: set[str] = set()

    def step(self, sample: Sample) -> Sample:
        """The sample without exchanged pictures; ``faults`` names their cameras."""
        seen = {name: _standard(_small(picture)) for name, picture in (sample.pictures or {}).items()}
        before, self._exchanged = self._exchanged, set()
        for pair in combinations(seen, 2):
            margin = 0.0 if before.issuperset(pair) else MARGIN
            if self._better_exchanged(*pair, seen) > margin:
                self._exchanged |= set(pair)
        faults = dict.fromkeys(sorted(self._exchanged), CameraFault.EXCHANGED)
        if not faults:
            for name, look in seen.items():
                self._learn(name, look)
            return sample
        pictures = {name: picture for name, picture in sample.pictures.items() if name not in faults}
        return replace(sample, pictures=pictures, faults={**sample.faults, **faults})

    def _better_exchanged(self, one: str, other: str, seen: Mapping[str, np.ndarray]) -> float:
        """By how much two pictures are liker each other's camera than their own; 0 where one is not known."""
        if one not in self._looks or other not in self._looks:
            return 0.0
        looks = np.array([self._looks[one], self._looks[other]])
        likeness = np.array([seen[one], seen[other]]) @ looks.T
        return float(np.fliplr(likeness).trace() - likeness.trace()) / 2

    def _learn(self, name: str, look: np.ndarray) -> None:
        mixed = (1 - LEARNT) * self._looks.get(name, look) + LEARNT * look
        self._looks[name] = mixed / max(float(np.linalg.norm(mixed)), 1e-9)


def _small(picture: np.ndarray) -> np.ndarray:
    return cv2.resize(picture, (TYPICAL_SIDE, TYPICAL_SIDE), interpolation=cv2.INTER_AREA)


def _standard(picture: np.ndarray) -> np.ndarray:
    """Grey levels (576,) about their mean, of length 1; zeros of a picture of one level."""
    values = picture.astype(np.float32).ravel()
    values -= values.mean()
    return values / max(float(np.linalg.norm(values)), 1e-9)
