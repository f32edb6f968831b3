"""Brings a camera's grey levels to those of a model's training, over a take or as frames come."""

import math
from collections.abc import Mapping
from dataclasses import replace

import cv2
import numpy as np

from regress.runtime.headset.footage import Footage
from regress.runtime.headset.looks import BRIGHT, DARK, CameraLooks, levels_of
from regress.runtime.headset.placement import CameraPlacement

_MEMORY_S = 10.0
"""In which live levels forget: eyes close several times meanwhile."""

_GREYS = np.arange(256)

_ENDS = np.array([DARK, BRIGHT]) / 100

_LEAST_RANGE = 8.0
"""Grey levels that a picture's darkest and brightest lie apart at least: stretching fewer makes pictures of noise."""


def level_table(low: float, high: float, looks: CameraLooks, *, fixed: bool = False) -> np.ndarray:
    """What each of 256 grey levels becomes (256,) uint8.

    Levels as people's pictures had them in training stay as they are; others are stretched to the nearest of those.

    Parameters
    ----------
    low, high
        Percentiles `DARK` and `BRIGHT` of the camera's pictures.
    looks
        Of the camera in training.
    fixed
        Whether they become the middle one of training's in any case, as a placement's do.
    """
    high = max(high, low + _LEAST_RANGE)
    if fixed:
        wanted_low, wanted_high = looks.low[1], looks.high[1]
    else:
        wanted_low = min(max(low, looks.low[0]), looks.low[2])
        wanted_high = min(max(high, looks.high[0]), looks.high[2])
    slope = (wanted_high - wanted_low) / (high - low)
    table = wanted_low + slope * (_GREYS - low)
    return np.rint(table).clip(0, 255).astype(np.uint8)


def tables_of(
    footage: Footage,
    looks: Mapping[str, CameraLooks],
    placement: Mapping[str, CameraPlacement],
) -> dict[str, np.ndarray]:
    """`level_table` of each camera of a take, of cameras whose looks the model knows and that have pictures.

    Levels that a placement names go before those that the take has.
    """
    tables = {}
    for column, name in enumerate(footage.cameras):
        rows = footage.present[:, column]
        if name not in looks or not rows.any():
            continue
        named = placement.get(name)
        if named is not None and named.low is not None:
            tables[name] = level_table(named.low, named.high, looks[name], fixed=True)
        else:
            tables[name] = level_table(*levels_of(footage.pictures[name][rows]), looks[name])
    return tables


def levelled(footage: Footage, tables: Mapping[str, np.ndarray]) -> Footage:
    """A take whose pictures that count have a table's levels; those at fault stay 0."""
    pictures = dict(footage.pictures)
    for name, table in tables.items():
        there = footage.present[:, footage.cameras.index(name)]
        pictures[name] = np.where(there[:, None, None], table[pictures[name]], pictures[name])
    return replace(footage, pictures=pictures)


class Levels:
    """Levels pictures as they come, by the levels of the last ten seconds or so.

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
        self._counts: dict[str, np.ndarray] = {}
        self._seen: dict[str, tuple[float, float]] = {}
        self._tables: dict[str, np.ndarray] = {}
        self._fixed = {
            name: level_table(one.low, one.high, looks[name], fixed=True)
            for name, one in (placement or {}).items()
            if one.low is not None and one.high is not None and name in looks
        }
        self._tables |= self._fixed

    def step(self, seconds: float, pictures: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """The next frame's pictures (h, w) uint8 by camera, levelled; ``seconds`` since the frame before."""
        for name, picture in pictures.items():
            if name in self._looks and name not in self._fixed:
                self._see(name, picture, seconds)
        return self.levelled(pictures)

    def levelled(self, pictures: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Pictures (h, w) uint8 by camera with the levels of the moment: a neutral picture's are the frames'."""
        return {
            name: cv2.LUT(picture, self._tables[name]) if name in self._tables else picture
            for name, picture in pictures.items()
        }

    def _see(self, name: str, picture: np.ndarray, seconds: float) -> None:
        """Count a picture's levels for as long as it lasts; the table stays as long as their ends do."""
        seen = cv2.calcHist([picture], [0], None, [256], [0, 256]).ravel() / picture.size
        before = self._counts.get(name)
        kept = 0.0 if before is None else before * math.exp(-seconds / _MEMORY_S)
        self._counts[name] = counts = kept + seconds * seen
        shares = np.cumsum(counts)
        low, high = np.searchsorted(shares, shares[-1] * _ENDS)
        ends = float(low), float(high)
        if self._seen.get(name) != ends:
            self._seen[name], self._tables[name] = ends, level_table(*ends, self._looks[name])
