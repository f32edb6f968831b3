"""Whether the headset still sits as it did when the neutral pictures were taken."""

from collections import deque
from itertools import islice

import numpy as np

PATIENCE_S = 0.5
"""Seconds of the running mean, and how long it must say that the seat has changed: a blink is shorter."""

_ROUNDING_S = 1e-6


class SeatWatch:
    """Watches the network's own word on the seat, frame by frame.

    A frame is compared with the neutral pictures while the mean over the last `PATIENCE_S` is one half or more. Where
    the mean stays below one half for as long, the seat has changed for good, from the frame at which the mean fell. A
    headset that comes back to its old seat exactly does not happen. A mean of fewer frames, as a take begins, casts
    doubt but counts for nothing more: a blink would be most of it.

    Attributes
    ----------
    changed
        Whether the seat has changed.
    """

    def __init__(self) -> None:
        self._recent: deque[tuple[float, float]] = deque()
        self._doubtful_s = 0.0
        self.changed = False

    def step(self, seconds: float, same_seat: float) -> bool:
        """Whether the next frame may be compared.

        Parameters
        ----------
        seconds
            Since the frame before.
        same_seat
            The network's probability; frames without pictures have none, and are left out.
        """
        self._recent.append((seconds, same_seat))
        while self._covered(1):
            self._recent.popleft()
        doubtful = bool(np.mean([value for _, value in self._recent]) < 0.5)
        self._doubtful_s = self._doubtful_s + seconds if doubtful and self._covered(0) else 0.0
        self.changed = self.changed or self._doubtful_s > PATIENCE_S - _ROUNDING_S
        return not (doubtful or self.changed)

    def _covered(self, first: int) -> bool:
        """Whether the frames from the ``first`` remembered one on last `PATIENCE_S`."""
        return sum(seconds for seconds, _ in islice(self._recent, first, None)) > PATIENCE_S - _ROUNDING_S
