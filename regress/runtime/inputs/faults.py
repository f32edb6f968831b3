"""Rows that cannot be used: no face, a face that has collapsed or is the wrong way round, times out of order."""

import math
from collections.abc import Sequence
from enum import Enum
from itertools import pairwise

import numpy as np

from facegen.conventions import LANDMARK_GROUPS
from facegen.number_ranges import format_ranges

OUTLINE = np.array(
    [
        *LANDMARK_GROUPS["jaw"],
        *reversed(LANDMARK_GROUPS["left_brow"]),
        *reversed(LANDMARK_GROUPS["right_brow"]),
    ]
)
"""Jaw from the subject's right ear over the chin, then back along the brows: once round the face."""

_NEXT = np.roll(OUTLINE, -1)

FLAT = 1e-3
"""Determinant of the points' covariance over its trace squared, at or below which they are on one line.

Faces of the default dataset have 0.2 and more, profiles too.
"""

TURNED = 0.1
"""Area of the outline, over the square of twice the extent, above which it runs the wrong way round.

Faces of the default dataset have -0.38 to -0.79, recorded ones -0.35 to -0.71, a profile 0, mirrored ones the opposite.
"""


_FARTHEST, _SMALLEST = 1e15, 1e-15
"""Of a coordinate and of a face's half size, in pixels: alignment takes the fourth power of both."""


_LOOKED_AHEAD = 2
"""Times behind one by which it is told from those that are late: where it alone is wrong, both are in order."""

_FEWEST_OF_SET_CLOCK = 5
"""Frames that a clock that was set has shown, also of a camera that gives few."""


class Fault(Enum):
    """What is wrong with a row; the value says what it has."""

    MISSING = "no face"
    UNREADABLE = "something else than 136 numbers, or 137 with the time before them"
    COLLAPSED = "all points in one place or on one line"
    MIRRORED = "left and right exchanged, or y pointing up"
    DISORDER = "a time that is not later than those before"
    TIMELESS = "no time, which smoothing needs"


def face_faults(points: np.ndarray) -> list[Fault | None]:
    """What is wrong with each face.

    Parameters
    ----------
    points : (n, 68, 2) float64
        Pixels, y down; NaN and what lies beyond `_FARTHEST`, as infinity does, are missing points.
    """
    usable = (np.abs(points) < _FARTHEST).all(axis=(1, 2))
    x, y = np.where(usable[:, None, None], points, 0.0).transpose(2, 0, 1)
    x, y = x - x.mean(axis=1, keepdims=True), y - y.mean(axis=1, keepdims=True)
    extent = np.maximum(np.abs(x).max(axis=1), np.abs(y).max(axis=1))
    scale = 1 / np.where(extent > _SMALLEST, extent, np.inf)[:, None]
    x, y = x * scale, y * scale
    xx, yy, xy = (np.einsum("nk,nk->n", *pair) for pair in ((x, x), (y, y), (x, y)))
    collapsed = ~(xx * yy - xy * xy > FLAT * (xx + yy) ** 2)
    cross = x[:, OUTLINE] * y[:, _NEXT] - y[:, OUTLINE] * x[:, _NEXT]
    mirrored = cross.sum(axis=1) / 8 > TURNED  # half of the sum, over the square of twice the extent of 1
    return [
        Fault.MISSING if not sound else Fault.COLLAPSED if flat else Fault.MIRRORED if turned else None
        for sound, flat, turned in zip(usable, collapsed, mirrored, strict=True)
    ]


class TimeOrder:
    """Watches times as they come: one must not be less than the latest before it.

    Parameters
    ----------
    strictly
        As smoothing needs it: greater, and known. Two faces of one picture share a time otherwise.
    set_after_s
        How long times must be in order among themselves, farther than this behind the latest, to be of a clock that
        was set: it counts from then on. None leaves them out for good, as a file's times should go one way.
    """

    def __init__(self, *, strictly: bool, set_after_s: float | None = None) -> None:
        self._strictly, self._set_after_s = strictly, set_after_s
        self._latest = -math.inf
        self._behind: list[float] = []

    def run(self, times_s: Sequence[float]) -> list[Fault | None]:
        """What is wrong with each of the next times; one that leaps over both behind it is wrong, and not they."""
        return [
            self._step(time_s, times_s[place : place + _LOOKED_AHEAD])
            for place, time_s in enumerate(times_s, start=1)
        ]

    def step(self, time_s: float) -> Fault | None:
        """What is wrong with the next time; NaN where it is not known."""
        return self._step(time_s, ())

    def _step(self, time_s: float, ahead: Sequence[float]) -> Fault | None:
        if not math.isfinite(time_s):
            return Fault.TIMELESS if self._strictly else None
        leaps = len(ahead) == _LOOKED_AHEAD and self._rise([self._latest, *ahead]) and ahead[-1] < time_s
        late = not self._rise([self._latest, time_s])
        if leaps or (late and not self._is_of_set_clock(time_s)):
            return Fault.DISORDER
        self._latest = time_s
        self._behind.clear()
        return None

    def _is_of_set_clock(self, time_s: float) -> bool:
        if self._set_after_s is None or self._latest - time_s <= self._set_after_s:
            return False
        if not self._rise([*self._behind[-1:], time_s]):
            self._behind.clear()
        self._behind.append(time_s)
        lasted_s = time_s - self._behind[0]
        return len(self._behind) >= _FEWEST_OF_SET_CLOCK and lasted_s >= self._set_after_s

    def _rise(self, times_s: Sequence[float]) -> bool:
        """Whether times are in order; none is where one is not known."""
        return all(a < b or (a == b and not self._strictly) for a, b in pairwise(times_s))


def fault_sentences(faults: list[Fault | None]) -> list[str]:
    """A line a kind: how many rows, and which, counted from 1."""
    lines = []
    for fault in Fault:
        rows = [row for row, other in enumerate(faults, start=1) if other is fault]
        if rows:
            lines.append(
                f"{len(rows)} of {len(faults)} rows have {fault.value}: {format_ranges(rows, separator=', ')}"
            )
    return lines
