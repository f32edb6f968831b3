"""Brings a camera's grey levels to the middle ones of a model's training, whatever its light does.

Each picture has a brightness of its own, so a lamp that changes, a camera that sets its exposure by itself and a
neutral picture of another day all come out alike. How dark and how bright a camera's darkest and brightest are beside
that belongs to the person and the camera, and is measured over a take, or over ten seconds.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import cv2
import numpy as np

from regress.runtime.headset.pictures.looks import BRIGHT, DARK, CameraLooks
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.recordings.footage import Footage

_MEMORY_S = 10.0
"""In which live ends are forgotten: eyes close several times meanwhile."""

_GREYS = np.arange(256)

_ENDS = np.array([DARK, BRIGHT]) / 100

_MIDDLE = np.array([0.5, 0.75])
"""Of a picture's pixels, sorted: their mean is its brightness. A dark rim may cover half, glare a quarter."""

_LEAST_RANGE = 8.0
"""Grey levels that a picture's darkest and brightest lie apart at least: stretching fewer makes pictures of noise."""

_BINS = 64
"""In which levels are counted, to a brightness."""

_MOST_BRIGHT = 12.0
"""Brightnesses of a picture's brightest at most: of one that is nearly all rim, the rim is no measure."""

_SAME_END = 0.03
"""Brightnesses by which live ends move before they count: a neutral picture is encoded again when they do."""


@dataclass(frozen=True, kw_only=True)
class CameraLevels:
    """What a camera's grey levels become.

    Parameters
    ----------
    low, high
        Percentiles `DARK` and `BRIGHT` of its pictures, as multiples of each picture's brightness; grey levels where
        ``fixed``.
    wanted_low, wanted_high
        Grey levels that they become: the middle ones of training.
    fixed
        Whether all pictures get the same, as a placement can say.
    """

    low: float
    high: float
    wanted_low: float
    wanted_high: float
    fixed: bool = False

    def table(self, brightness: float = 1.0) -> np.ndarray:
        """What each of 256 grey levels becomes (256,) uint8, in a picture of this brightness."""
        times = 1.0 if self.fixed else brightness
        low = self.low * times
        high = max(self.high * times, low + _LEAST_RANGE)
        slope = (self.wanted_high - self.wanted_low) / (high - low)
        return np.rint(self.wanted_low + slope * (_GREYS - low)).clip(0, 255).astype(np.uint8)

    def apply(self, pictures: np.ndarray) -> np.ndarray:
        """Pictures (..., h, w) uint8 with those levels, each by its own brightness."""
        if pictures.ndim == 2:
            return cv2.LUT(pictures, self.table(1.0 if self.fixed else brightness_of(_counted(pictures))))
        return np.stack([self.apply(one) for one in pictures]) if len(pictures) else pictures


def brightness_of(counts: np.ndarray) -> float:
    """How bright a picture is, in grey levels, by how many of its pixels (256,) have each one."""
    total = float(counts.sum())
    shares = np.cumsum(counts) / total
    within = np.diff(shares.clip(*_MIDDLE), prepend=_MIDDLE[0])
    middle = float(within @ _GREYS) / float(_MIDDLE[1] - _MIDDLE[0])
    bright = float(np.searchsorted(shares, _ENDS[1]))
    return max(middle, bright / _MOST_BRIGHT, 1.0)


def levels_in(
    stacks: Iterable[np.ndarray], looks: CameraLooks, placement: CameraPlacement | None = None
) -> CameraLevels:
    """What grey levels of a camera's pictures (n, h, w) uint8, of one take or more, become.

    Levels that a placement names go before those that the pictures have.
    """
    named = _named(placement, looks)
    if named is not None:
        return named
    pool = _Pool(math.inf)
    for pictures in stacks:
        for picture in pictures:
            pool.see(picture, 1.0)
    return _to_training(*pool.ends, looks)


def levels_of_cameras(
    footage: Footage, looks: Mapping[str, CameraLooks], placement: Mapping[str, CameraPlacement]
) -> dict[str, CameraLevels]:
    """`levels_in` a take, of each camera whose looks the model knows and that has pictures."""
    there = dict(zip(footage.cameras, footage.present.T, strict=True))
    return {
        name: levels_in([footage.pictures[name][rows]], looks[name], placement.get(name))
        for name, rows in there.items()
        if name in looks and rows.any()
    }


def levelled(footage: Footage, levels: Mapping[str, CameraLevels]) -> Footage:
    """A take whose pictures that count have these levels; those at fault stay 0."""
    pictures = dict(footage.pictures)
    for name, one in levels.items():
        there = footage.present[:, footage.cameras.index(name)]
        pictures[name] = pictures[name].copy()
        pictures[name][there] = one.apply(pictures[name][there])
    return replace(footage, pictures=pictures)


class Levels:
    """Levels pictures as they come, by their own brightness and by the ends of the last ten seconds or so.

    Parameters
    ----------
    looks
        Of cameras in training; pictures of others stay as they are.
    placement
        Whose levels go before those that are seen.
    """

    def __init__(
        self, looks: Mapping[str, CameraLooks], placement: Mapping[str, CameraPlacement] | None = None
    ) -> None:
        self._looks = looks
        self._pools: dict[str, _Pool] = {}
        named = {name: _named((placement or {}).get(name), one) for name, one in looks.items()}
        self._levels = {name: one for name, one in named.items() if one is not None}

    def step(self, seconds: float, pictures: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """The next frame's pictures (h, w) uint8 by camera, levelled; ``seconds`` since the frame before."""
        seen = dict(pictures)
        for name, picture in pictures.items():
            if name not in self._looks:
                continue
            known = self._levels.get(name)
            if known is not None and known.fixed:
                seen[name] = known.apply(picture)
                continue
            pool = self._pools.setdefault(name, _Pool(_MEMORY_S))
            brightness = pool.see(picture, seconds)
            low, high = pool.ends
            if known is None or max(abs(low - known.low), abs(high - known.high)) > _SAME_END:
                known = self._levels[name] = _to_training(low, high, self._looks[name])
            seen[name] = cv2.LUT(picture, known.table(brightness))
        return seen

    def levelled(self, pictures: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Pictures (..., h, w) uint8 by camera, neutral ones or of before, with the ends of the moment."""
        return {
            name: self._levels[name].apply(picture) if name in self._levels else picture
            for name, picture in pictures.items()
        }


class _Pool:
    """How many pixels have which share of their picture's brightness, of pictures that are forgotten by and by."""

    def __init__(self, memory_s: float) -> None:
        self._memory_s = memory_s
        self._counts = np.zeros(int(_BINS * (_MOST_BRIGHT + 4)))

    def see(self, picture: np.ndarray, seconds: float) -> float:
        """Count a picture (h, w) uint8 for as long as it lasts, and say its brightness."""
        counts = _counted(picture)
        brightness = brightness_of(counts)
        places = np.rint(_GREYS * (_BINS / brightness)).astype(np.intp).clip(0, len(self._counts) - 1)
        self._counts *= math.exp(-seconds / self._memory_s)
        self._counts += np.bincount(
            places, weights=counts * (seconds / picture.size), minlength=len(self._counts)
        )
        return brightness

    @property
    def ends(self) -> tuple[float, float]:
        """Percentiles `DARK` and `BRIGHT`, in brightnesses."""
        shares = np.cumsum(self._counts)
        low, high = np.searchsorted(shares, shares[-1] * _ENDS) / _BINS
        return float(low), float(high)


def _counted(picture: np.ndarray) -> np.ndarray:
    return cv2.calcHist([picture], [0], None, [256], [0, 256]).ravel()


def _to_training(low: float, high: float, looks: CameraLooks) -> CameraLevels:
    return CameraLevels(low=low, high=high, wanted_low=looks.low[1], wanted_high=looks.high[1])


def _named(placement: CameraPlacement | None, looks: CameraLooks) -> CameraLevels | None:
    """The levels that a placement holds for all pictures."""
    if placement is None or placement.low is None or placement.high is None:
        return None
    return replace(_to_training(placement.low, placement.high, looks), fixed=True)
