"""What is wrong with a camera, and who finds it: black and frozen pictures."""

from enum import Enum

import numpy as np

from regress.runtime.headset.pictures.faults import is_black
from track.sources.source import Picture

FROZEN_S = 0.5
"""The same bytes for longer are no picture: a sensor's noise alone changes some byte of each."""

WAKES_WITHIN_S = 0.5
"""In which a camera that was opened opens its shutter and finds its exposure: until then dark pictures are no fault."""

_STRIDE = 8
"""Of the rows and columns by which pictures are first compared, and by which they are called black."""


class CameraFault(Enum):
    """What is wrong with a camera; the value says what it has, and is empty where nobody needs to know."""

    WAKING = ""
    UNPLUGGED = "no more pictures; it is tried again until they come back"
    SILENT = "no picture for a second"
    BLACK = "a black picture: a lens cap, a shutter, or no light"
    FROZEN = "the same picture over and over"
    LATE = "pictures that come later than those of the other cameras, so it is left out"
    UNREADABLE = "a file that is no picture"
    DISORDER = "a time that is not later than the one before"


class PictureWatch:
    """Watches the pictures of one camera, as they come.

    Parameters
    ----------
    moving
        Whether pictures must differ from one another: a film may show the same again, a camera does not.
    """

    def __init__(self, *, moving: bool) -> None:
        self._moving = moving
        self._first: Picture | None = None
        self._wakes_until_s: float | None = None

    def step(self, picture: Picture) -> CameraFault | None:
        """What is wrong with the next picture."""
        if picture.pixels is None:
            return None
        if self._wakes_until_s is None:
            self._wakes_until_s = picture.time_s + WAKES_WITHIN_S if self._moving else -np.inf
        if is_black(picture.pixels[::_STRIDE, ::_STRIDE]):
            return CameraFault.WAKING if picture.time_s <= self._wakes_until_s else CameraFault.BLACK
        self._wakes_until_s = -np.inf
        if self._first is None or not _same(self._first.pixels, picture.pixels):
            self._first = picture
        frozen = self._moving and picture.time_s - self._first.time_s > FROZEN_S
        return CameraFault.FROZEN if frozen else None


def _same(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two pictures have the same bytes; most differ in the few that are compared first."""
    few = np.s_[::_STRIDE, ::_STRIDE]
    return one.shape == other.shape and np.array_equal(one[few], other[few]) and np.array_equal(one, other)
