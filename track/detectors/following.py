"""Chooses among the faces in a picture: the one that is nearest to the face of before."""

import numpy as np

FORGOTTEN_S = 2.0
"""Without the face for this long, the largest one is the next to be followed: somebody else may sit down."""

LEAP = 1.0
"""Of a face's own width: one that is farther from where the followed one was is another person's, if others are there.

At 30 pictures a second a face moves by less than a tenth of its width from one to the next.
"""

QUICKEST = 3.0
"""Widths a second that a face moves at most; so far may one be that is alone, beyond `LEAP`, after it was not seen."""

ALONE_S = 0.3
"""A face that is alone, wherever it is, is the followed one's after so long: people lean, rise and come back."""


class Following:
    """Remembers where the followed face was."""

    def __init__(self) -> None:
        self._middle: np.ndarray | None = None
        self._seen_s = self._several_s = -np.inf
        self._alone_from_s: float | None = None

    def choose(self, faces: np.ndarray, time_s: float) -> int | None:
        """Index of the face to follow; None where only others are there.

        Parameters
        ----------
        faces : (n, 68, 2) float64
            Pixels; n may be 0.
        time_s
            Of the picture.
        """
        if len(faces) > 1:
            self._several_s = time_s
        if not len(faces):
            self._alone_from_s = None
            return None
        middles, widths = faces.mean(axis=1), np.ptp(faces[..., 0], axis=1)
        if self._middle is None or not self._remembers(self._seen_s, time_s):
            chosen = int(np.argmax(widths))
        else:
            apart = np.linalg.norm(middles - self._middle, axis=1)
            chosen = int(np.argmin(apart))
            if not self._is_followed(apart[chosen] / widths[chosen], time_s):
                return None
        self._middle, self._seen_s, self._alone_from_s = middles[chosen], time_s, None
        return chosen

    def others(self, time_s: float) -> bool:
        """Whether several faces are in the picture of a time, or were so shortly before that a lone one may be any."""
        return self._remembers(self._several_s, time_s)

    def _is_followed(self, widths: float, time_s: float) -> bool:
        """Whether the nearest face, so many of its widths from where the followed one was, is the same one."""
        if widths <= LEAP:
            return True
        if self.others(time_s):
            self._alone_from_s = None
            return False
        if self._alone_from_s is None or time_s < self._alone_from_s:
            self._alone_from_s = time_s
        near = widths <= LEAP + QUICKEST * (time_s - self._seen_s)
        return near or time_s - self._alone_from_s >= ALONE_S

    @staticmethod
    def _remembers(last_s: float, time_s: float) -> bool:
        return 0 <= time_s - last_s <= FORGOTTEN_S
