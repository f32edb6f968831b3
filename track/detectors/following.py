"""Chooses among the faces in a picture: the one that is nearest to the face of before."""

import numpy as np

FORGOTTEN_S = 2.0
"""Without the face for this long, the largest one is the next to be followed: somebody else may sit down."""

LEAP = 1.0
"""Of a face's own width: one that is farther from where the followed one was is another person's.

At 30 pictures a second a face moves by less than a tenth of its width from one to the next.
"""


class Following:
    """Remembers where the followed face was."""

    def __init__(self) -> None:
        self._middle: np.ndarray | None = None
        self._seen_s = -np.inf

    def choose(self, faces: np.ndarray, time_s: float) -> int | None:
        """Index of the face to follow; None where only others are there.

        Parameters
        ----------
        faces : (n, 68, 2) float64
            Pixels; n may be 0.
        time_s
            Of the picture.
        """
        if not len(faces):
            return None
        middles, widths = faces.mean(axis=1), np.ptp(faces[..., 0], axis=1)
        if self._middle is None or not 0 <= time_s - self._seen_s <= FORGOTTEN_S:
            chosen = int(np.argmax(widths))
        else:
            apart = np.linalg.norm(middles - self._middle, axis=1)
            chosen = int(np.argmin(apart))
            if apart[chosen] > LEAP * widths[chosen]:
                return None
        self._middle, self._seen_s = middles[chosen], time_s
        return chosen
