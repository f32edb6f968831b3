"""Whether a headset's cameras were exchanged while it is worn, or two show one picture: by what each showed lately."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from enum import Enum
from itertools import combinations

import cv2
import numpy as np

from regress.runtime.headset.pictures.typical import TYPICAL_SIDE
from regress.runtime.sample import Sample
from regress.runtime.stages.frame_clock import FrameClock
from regress.runtime.stages.stage import Stage

LATELY_S = 0.5
"""In which what a camera showed is forgotten, at any frame rate: two cameras whose pictures differ little would else be
learnt for each other before anybody is told. For as long two cameras show one picture before it is told."""

MARGIN = 0.15
"""Mean correlation by which two pictures must be liker each other's camera than their own; while they are exchanged
nothing more is asked for."""

SAME = 0.98
"""Correlation of two cameras' pictures from which they are one: those of a face's two eyes reach .87."""


class CameraFault(Enum):
    """What is wrong with a camera's place; the value says what it has."""

    EXCHANGED = "pictures that look like another camera's; are two exchanged?"
    SAME = "the same picture as another camera; does one of them show the wrong place?"


class ExchangeWatch(Stage):
    """Takes pictures away that look like another camera's; a camera is known from its first picture on.

    What was found stays found while one of the two is away: the other one cannot say that it is in its place again.
    Cameras that are exchanged from the beginning are told by `UprightWatch` and `regress headset check`, not here; of
    two that show one picture from the beginning nobody knows which is right, and neither counts.
    """

    def __init__(self) -> None:
        self._looks: dict[str, np.ndarray] = {}
        self._exchanged: set[frozenset[str]] = set()
        self._same = _SamePictures()
        self._clock = FrameClock()

    def step(self, sample: Sample) -> Sample:
        """The sample without exchanged pictures; ``faults`` names their cameras, and both that show one picture."""
        seconds = self._clock.step(sample.time_s)
        seen = {name: _standard(_small(picture)) for name, picture in (sample.pictures or {}).items()}
        alike, same = self._same.step(seconds, seen)
        pairs = {*self._exchanged, *map(frozenset, combinations(seen, 2))}
        self._exchanged = {
            pair
            for pair in pairs
            if (pair in self._exchanged if pair in alike else self._is_crossed(pair, seen))
        }
        found = _names(self._exchanged, seen)
        learnt = 1 - math.exp(-seconds / LATELY_S)
        for name in seen.keys() - found - _names(alike, seen):
            self._learn(name, seen[name], learnt)
        strangers = frozenset().union(*(self._strangers(pair, seen) for pair in same))
        twice = strangers | _names((pair for pair in same if pair <= seen.keys()), seen)
        if not found and not twice:
            return sample
        faults = dict.fromkeys(sorted(twice), CameraFault.SAME)
        faults |= dict.fromkeys(sorted(found), CameraFault.EXCHANGED)
        pictures = {
            name: picture for name, picture in sample.pictures.items() if name not in found | strangers
        }
        return replace(sample, pictures=pictures, faults={**sample.faults, **faults})

    def _is_crossed(self, pair: frozenset[str], seen: Mapping[str, np.ndarray]) -> bool:
        """Whether two cameras show each other's pictures."""
        before = pair in self._exchanged
        there = [name for name in pair if name in seen]
        if not there or not pair <= self._looks.keys():
            return before
        # by how much pictures are liker the other's camera than their own
        crossed = sum(self._liker_other(name, pair, seen) for name in there) / len(there)
        if len(there) == 1:
            return before and crossed > -MARGIN
        return crossed > (0.0 if before else MARGIN)

    def _liker_other(self, name: str, pair: frozenset[str], seen: Mapping[str, np.ndarray]) -> float:
        (other,) = pair - {name}
        return float(seen[name] @ (self._looks[other] - self._looks[name]))

    def _strangers(self, pair: frozenset[str], seen: Mapping[str, np.ndarray]) -> frozenset[str]:
        """Which of two cameras that show one picture may not show their own."""
        known = pair <= self._looks.keys()
        return frozenset(
            name for name in pair & seen.keys() if not known or self._liker_other(name, pair, seen) > -MARGIN
        )

    def _learn(self, name: str, look: np.ndarray, share: float) -> None:
        mixed = (1 - share) * self._looks.get(name, look) + share * look
        self._looks[name] = _normed(mixed)


def counted_pictures(sample: Sample) -> dict[str, np.ndarray]:
    """Pictures of the cameras of whose place nothing is known to be wrong: of others nothing is to be learnt."""
    return {
        name: picture
        for name, picture in (sample.pictures or {}).items()
        if not isinstance(sample.faults.get(name), CameraFault)
    }


class _SamePictures:
    """Pairs of cameras that show one picture, once they do for `LATELY_S`, until for as long they do not."""

    def __init__(self) -> None:
        self._same: set[frozenset[str]] = set()
        self._against_s: dict[frozenset[str], float] = {}

    def step(
        self, seconds: float, seen: Mapping[str, np.ndarray]
    ) -> tuple[set[frozenset[str]], set[frozenset[str]]]:
        """Pairs of which a frame says so, or all frames of late; and those of the latter. A pair of which one is away
        stays what it was."""
        alike = set()
        for pair in map(frozenset, combinations(seen, 2)):
            one, other = pair
            now = float(seen[one] @ seen[other]) >= SAME
            if now:
                alike.add(pair)
            if now == (pair in self._same):
                self._against_s.pop(pair, None)
                continue
            self._against_s[pair] = self._against_s.get(pair, 0.0) + seconds
            if self._against_s[pair] > LATELY_S:
                self._same ^= {pair}
                del self._against_s[pair]
        return alike | self._same, set(self._same)


def _names(pairs: Iterable[frozenset[str]], seen: Mapping[str, np.ndarray]) -> frozenset[str]:
    """Cameras of these pairs that give a picture."""
    return frozenset(name for pair in pairs for name in pair if name in seen)


def _small(picture: np.ndarray) -> np.ndarray:
    return cv2.resize(picture, (TYPICAL_SIDE, TYPICAL_SIDE), interpolation=cv2.INTER_AREA)


def _standard(picture: np.ndarray) -> np.ndarray:
    """Grey levels (576,) about their mean, of length 1; zeros of a picture of one level."""
    values = picture.astype(np.float32).ravel()
    return _normed(values - values.mean())


def _normed(values: np.ndarray) -> np.ndarray:
    return values / max(float(values @ values) ** 0.5, 1e-9)
