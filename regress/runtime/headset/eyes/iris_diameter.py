"""Follows the diameter of an eye's iris in pixels: the unit of length of all that is traced of the eye."""

from collections import deque

import numpy as np

from regress.runtime.headset.eyes.eye_points import EyePoints

_KEEP_EVERY_S, _MEMORY = 0.025, 300
"""Diameters are kept no oftener, and so many; their median is the iris's. It spans 7.5 seconds or more, in which eyes
are open for most: a half-hidden iris is traced too small."""

_SETTLED = 30
"""Diameters of which a median changes little by one more."""

_ROUNDING_S = 1e-6


class IrisDiameter:
    """Median of an iris's diameter in pixels, which changes with the seat alone: counted anew now and then."""

    def __init__(self) -> None:
        self.held: float | None = None
        self.median = float("nan")
        self._kept: deque[float] = deque(maxlen=_MEMORY)
        self._count, self._since_s = 0, float("inf")

    def step(self, seconds: float, diameter: float) -> float:
        """The median, with a frame's diameter where one is due."""
        self._since_s += seconds
        if self.held is not None:
            self.median = self.held
        elif self._since_s > _KEEP_EVERY_S - _ROUNDING_S:
            self._kept.append(diameter)
            self._count, self._since_s = self._count + 1, 0.0
            if self._count < _SETTLED or self._count % _SETTLED == 0:
                self.median = float(np.median(self._kept))
        return self.median


def diameter_of(points: np.ndarray, eye: EyePoints) -> float:
    """Of the iris, pixels; its points lie evenly on an ellipse."""
    iris = points[eye.iris]
    return 2 * mean_length(iris - iris.sum(axis=0) / len(iris))


def mean_length(rows: np.ndarray) -> float:
    """Of vectors (n, 2); a third of the time of `numpy.linalg.norm` for as few."""
    return float(np.hypot(rows[:, 0], rows[:, 1]).sum() / len(rows))
