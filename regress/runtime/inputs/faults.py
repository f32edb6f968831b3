"""Rows that cannot be used: no face, a face that has collapsed or is the wrong way round, times out of order."""

import math
from enum import Enum

import numpy as np

from facegen.conventions import LANDMARK_GROUPS
from facegen.number_ranges import format_ranges

_OUTLINE = np.array(
    [
        *LANDMARK_GROUPS["jaw"],
        *reversed(LANDMARK_GROUPS["left_brow"]),
        *reversed(LANDMARK_GROUPS["right_brow"]),
    ]
)
"""Jaw from the subject's right ear over the chin, then back along the brows: once round the face."""

_NEXT = np.roll(_OUTLINE, -1)

_FLAT = 1e-3
"""Determinant of the points' covariance over its trace squared, at or below which they are on one line.

Faces of the default dataset have 0.2 and more, profiles too.
"""

_TURNED = 0.1
"""Area of the outline, over the square of twice the extent, above which it runs the wrong way round.

Faces of the default dataset have -0.38 to -0.79, recorded ones -0.35 to -0.71, a profile 0, mirrored ones the opposite.
"""


_FARTHEST, _SMALLEST = 1e15, 1e-15
"""Of a coordinate and of a face's half size, in pixels: alignment takes the fourth power of both."""


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
    collapsed = ~(xx * yy - xy * xy > _FLAT * (xx + yy) ** 2)
    cross = x[:, _OUTLINE] * y[:, _NEXT] - y[:, _OUTLINE] * x[:, _NEXT]
    mirrored = cross.sum(axis=1) / 8 > _TURNED  # half of the sum, over the square of twice the extent of 1
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
    """

    def __init__(self, *, strictly: bool) -> None:
        self._strictly = strictly
        self._latest = -math.inf

    def step(self, time_s: float) -> Fault | None:
        """What is wrong with the next time; NaN where it is not known."""
        if not math.isfinite(time_s):
            return Fault.TIMELESS if self._strictly else None
        late = time_s < self._latest or (self._strictly and time_s == self._latest)
        self._latest = max(self._latest, time_s)
        return Fault.DISORDER if late else None


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
