"""Tells without targets which of two answers about an eye's gaze leads: the network's own, or that of traced points.

At home the network's own answer is the better one. Of a camera unlike the training's it is not: pictures that look
strange pull it to the middle, and traced points go with the eye. So the points lead where they move farther than the
network's answer. At home they move by .75 to .89 times as far, of rendered eyes before other cameras by 1.16 times at
most, and on two films of real eyes by 1.2 to 1.8 times.
"""

import math

import numpy as np

_REMEMBERED_S = 20.0
"""After which a frame counts by a third."""

_COMING_S = 1.0
"""In which most of a change of who leads comes in: a gaze does not jump."""

_FROM, _TO = 1.0, 1.2
"""How much farther points move where they begin to count, and where they lead."""

_AT_HOME, _TRUST_DEG2_S = 0.8, 40.0
"""How far they move in the training's own headset, and what this counts against what is seen: two seconds in which eyes
look about by 4 degrees weigh as much."""


class GazeLead:
    """Learns from an eye's frames how far the answers of traced points move against the network's.

    Attributes
    ----------
    share : float
        How much the traced answer counts in the last frame, in [0, 1].
    """

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Begin anew, with the network's own answer: another person's or another take's frames follow."""
        self.share, self._calm = 0.0, 0.0
        self._seconds, self._together, self._own = 0.0, 0.0, 0.0
        self._traced, self._direct = np.zeros(2), np.zeros(2)

    def step(self, seconds: float, traced_deg: np.ndarray, direct_deg: np.ndarray, *, seen: float) -> None:
        """Learn from a frame.

        Parameters
        ----------
        seconds
            Since the frame before.
        traced_deg, direct_deg : (2,)
            Both answers; of traced ones that are NaN nothing is learnt.
        seen
            How much of the pupil lids leave to be seen, in [0, 1]: points say little of the rest.
        """
        traced = bool(np.isfinite(traced_deg).all())
        if traced and seen == 1:
            self._learn(seconds, traced_deg, direct_deg)
        # of the traced on the direct one, so that whatever is noise in either speaks for the network
        farther = (self._together + _TRUST_DEG2_S * _AT_HOME) / (self._own + _TRUST_DEG2_S)
        goal = min(max((farther - _FROM) / (_TO - _FROM), 0.0), 1.0)
        self._calm += (1 - math.exp(-seconds / _COMING_S)) * (goal - self._calm)
        self.share = self._calm * seen if traced else 0.0

    def led(self, traced_deg: np.ndarray, direct_deg: np.ndarray) -> np.ndarray:
        """Gaze (2,) in degrees of the last frame: the traced answer as far as it leads, about the other's middle."""
        if not self.share:
            return direct_deg
        about = traced_deg - self._traced + self._direct
        return direct_deg + self.share * (about - direct_deg)

    def _learn(self, seconds: float, traced_deg: np.ndarray, direct_deg: np.ndarray) -> None:
        """Means of both answers, and how the traced one goes with the direct one, over what is remembered."""
        kept = math.exp(-seconds / _REMEMBERED_S)
        self._seconds = kept * self._seconds + seconds
        if self._seconds <= 0:
            return
        share = seconds / self._seconds
        beside_traced, beside_direct = traced_deg - self._traced, direct_deg - self._direct
        self._traced = self._traced + share * beside_traced
        self._direct = self._direct + share * beside_direct
        after = direct_deg - self._direct
        self._together = kept * self._together + seconds * float(beside_traced @ after)
        self._own = kept * self._own + seconds * float(beside_direct @ after)


def led_take(
    traced_deg: np.ndarray, direct_deg: np.ndarray, *, seen: np.ndarray, seconds: np.ndarray
) -> np.ndarray:
    """Gaze (n, 2) in degrees of a take's frames, of which all were seen before.

    Parameters
    ----------
    traced_deg, direct_deg : (n, 2)
        Both answers; NaN of points that are not traced.
    seen : (n,)
        How much of the pupil lids leave to be seen, in [0, 1].
    seconds : (n,)
        Since the frame before.
    """
    lead = GazeLead()
    frames = list(zip(seconds, traced_deg, direct_deg, seen, strict=True))
    for passed, traced, direct, open_to in frames:
        lead.step(passed, traced, direct, seen=open_to)
    found = np.empty_like(direct_deg)
    for row, (passed, traced, direct, open_to) in enumerate(frames):
        lead.step(passed, traced, direct, seen=open_to)
        found[row] = lead.led(traced, direct)
    return found
