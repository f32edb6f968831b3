"""Tells how long each frame lasts, so that what is remembered is remembered for seconds, at any frame rate."""

import math

USUAL_FPS = 30.0
"""Frames a second where neither times nor people say it."""

LONGEST_STEP_S = 0.1
"""What a frame lasts at most: a pause says nothing of what went on in it, and nothing is forgotten over it."""


class FrameClock:
    """Seconds from each frame to the next one.

    Parameters
    ----------
    fps
        Frames a second of a take without times, and what a take's first frame lasts.
    """

    def __init__(self, fps: float = USUAL_FPS) -> None:
        self._usual_s = min(1 / fps, LONGEST_STEP_S)
        self._last_s: float | None = None

    def step(self, time_s: float | None) -> float:
        """Seconds since the frame before, `LONGEST_STEP_S` at most.

        Parameters
        ----------
        time_s
            Of the frame. Where it is None, NaN or no later than the one before, the frame lasts as long as most do.
        """
        if time_s is None or math.isnan(time_s):
            return self._usual_s
        last_s, self._last_s = self._last_s, time_s
        if last_s is None or time_s <= last_s:
            return self._usual_s
        return min(time_s - last_s, LONGEST_STEP_S)
