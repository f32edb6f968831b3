"""Says where the middle between an eye's corners lies, over about a second of open eyes.

The eyeball goes with the head and the headset, and so do the corners, but for skin: cheeks, brows and lids that close
pull at them, and the gaze is read from where the pupil lies between them. One frame's corners make a gaze restless, and
a whole take's are wrong as soon as the headset slips. Pictures that are cut out anew move all at once: then what was
remembered is forgotten.
"""

import math

import numpy as np

from regress.runtime.headset.eyes.eye_points import EyePoints

_REMEMBERED_S = 1.0
"""After which a frame counts by a third: faces change as fast, headsets slip more slowly."""

_JUMP_IRISES = 0.25
"""Off the calm middle by more, the picture has moved and not the skin: of rendered faces one frame in a hundred is off
by 0.2."""


def between_corners(points: np.ndarray, eye: EyePoints) -> np.ndarray:
    """Middle (..., 2) between both corners of the lids of points (..., P, 2)."""
    return points[..., [eye.upper[0], eye.upper[-1]], :].mean(axis=-2)


class EyeCorners:
    """Follows the middle between one eye's corners, frame by frame.

    Attributes
    ----------
    middle : (2,) float64
        Pixels; of the last frame, where no eye was open yet.
    weight : float
        Of how many frames it is the mean; 0 where no eye was open yet.
    """

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Begin anew: the eye was not seen, or another take begins."""
        self.middle, self.weight = np.full(2, np.nan), 0.0

    def step(self, seconds: float, middle: np.ndarray, *, iris: float, shut: bool) -> np.ndarray:
        """The calm middle (2,).

        Parameters
        ----------
        seconds
            Since the frame before.
        middle : (2,)
            As this frame has it; NaN where the eye is not seen.
        iris
            Diameter of the iris in pixels.
        shut
            Whether the lids are more shut than open: they pull the corners along, and the frame does not count.
        """
        self.weight *= math.exp(-seconds / _REMEMBERED_S)
        seen = bool(np.isfinite(middle).all())
        known = seen and self.weight > 0
        if known and shut:
            return self.middle
        if known and math.hypot(*(middle - self.middle)) <= _JUMP_IRISES * iris:
            self.weight += 1.0
            self.middle = self.middle + (middle - self.middle) / self.weight
        else:
            self.middle, self.weight = middle, float(seen and not shut)
        return self.middle


def calm_corners(
    points: np.ndarray, eye: EyePoints, *, iris: float, shut: np.ndarray, seconds: np.ndarray
) -> np.ndarray:
    """The calm middles (n, 2) of a take's points (n, P, 2), over the frames about each.

    Parameters
    ----------
    iris
        Diameter of the iris in pixels.
    shut : (n,) bool
        Frames whose lids are more shut than open.
    seconds : (n,)
        Since the frame before.
    """
    middles = between_corners(points, eye)
    found, weights = np.empty((2, len(middles), 2)), np.empty((2, len(middles), 1))
    after = np.append(seconds[1:], 0.0)
    for way, passed in ((1, seconds), (-1, after)):
        corners, side = EyeCorners(), (1 - way) // 2
        for row in range(len(middles))[::way]:
            found[side, row] = corners.step(passed[row], middles[row], iris=iris, shut=bool(shut[row]))
            weights[side, row] = corners.weight
    # where no eye was open all frames are as good
    weights += 1e-6
    return (weights * found).sum(axis=0) / weights.sum(axis=0)
