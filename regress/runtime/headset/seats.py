"""Whether the headset still sits as it did when the neutral pictures were taken."""

from collections import deque

import numpy as np

PATIENCE_S = 0.5
"""Seconds of the running mean, and how long it must say that the seat has changed: a blink is shorter."""


class SeatWatch:
    """Watches the network's own word on the seat, frame by frame.

    A frame is compared with the neutral pictures while the mean over the last `PATIENCE_S` is one half or more. Where
    the mean stays below one half for as long, the seat has changed for good, from the frame at which the mean fell. A
    headset that comes back to its old seat exactly does not happen. A mean of fewer frames, as a take begins, casts
    doubt but counts for nothing more: a blink would be most of it.

    Parameters
    ----------
    fps
        Frames a second.
    """

    def __init__(self, *, fps: float) -> None:
        self.patience_frames = max(1, round(PATIENCE_S * fps))
        self._recent: deque[float] = deque(maxlen=self.patience_frames)
        self._doubtful_frames = 0
        self.changed = False

    def step(self, same_seat: float) -> bool:
        """Whether the next frame may be compared.

        Parameters
        ----------
        same_seat
            The network's probability; frames without pictures have none, and are left out.
        """
        self._recent.append(same_seat)
        doubtful = bool(np.mean(self._recent) < 0.5)
        whole = len(self._recent) == self.patience_frames
        self._doubtful_frames = self._doubtful_frames + 1 if doubtful and whole else 0
        self.changed = self.changed or self._doubtful_frames >= self.patience_frames
        return not (doubtful or self.changed)
