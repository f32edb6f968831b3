"""Pictures of a film, at its own pace as a camera gives them, or one by one as fast as they are taken."""

import math
import threading
import time
from pathlib import Path

import cv2
import numpy as np

from facegen.formats.film import check_film_path
from track.errors import CameraError
from track.sources.opencv import grabbed, opened
from track.sources.source import Picture, Source

BEHIND_S = 1.0
"""A film that a busy machine shows later than this goes on from there: as a slower film, not later and later."""

_TYPICAL_FPS = 30.0
"""Of films that do not say."""


class Film(Source):
    """A film from its start to its end, once or over and over.

    Parameters
    ----------
    path
        Of any kind that OpenCV's FFmpeg reads.
    fast
        Whether every picture is wanted, as soon as the one before has been taken.
    again
        Whether it begins again behind its last picture; times go on.

    Raises
    ------
    CameraError
        Where it is no film, or has no picture.
    """

    endless = False

    def __init__(self, path: Path, *, fast: bool = False, again: bool = False) -> None:
        check_film_path(path)
        self.title, self.live = path.name, not fast
        self._path, self._again = path, again
        self._film = opened(str(path), cv2.CAP_FFMPEG)
        if self._film is None:
            raise CameraError(f"{path} is no film that can be read; .mp4, .avi, .mkv, .mov and .webm can")
        fps = self._film.get(cv2.CAP_PROP_FPS)
        self.step_s = 1 / fps if math.isfinite(fps) and fps > 0 else 1 / _TYPICAL_FPS
        count = self._film.get(cv2.CAP_PROP_FRAME_COUNT)
        self.length_s = count * self.step_s if math.isfinite(count) and count > 0 and not again else None
        self._next_s = self._last_s = self._before_s = 0.0
        self._begun_s: float | None = None
        self._stopped = threading.Event()

    def read(self) -> Picture | None:
        """The next picture, when it is due."""
        pixels = grabbed(self._film)
        if pixels is None and self._again and self._next_s > self._before_s:
            pixels = self._first_again()
        if pixels is None:
            return None
        told_s = self._film.get(cv2.CAP_PROP_POS_MSEC) / 1000
        # containers without times have 0 for all
        known = math.isfinite(told_s) and (told_s > 0 or self._next_s == 0)
        self._last_s = self._before_s + told_s if known else self._next_s
        self._next_s = self._last_s + self.step_s
        if self.live:
            if self._begun_s is None:
                self._begun_s = time.perf_counter() - self._last_s
            if self.now_s() > self._last_s + BEHIND_S:
                self._begun_s = time.perf_counter() - self._last_s
            self._stopped.wait(max(0.0, self._last_s - self.now_s()))
        return Picture(time_s=self._last_s, pixels=pixels)

    def now_s(self) -> float:
        """Time in the film: of its own pace, or of the picture that was read last."""
        return (
            time.perf_counter() - self._begun_s if self.live and self._begun_s is not None else self._last_s
        )

    def stop(self) -> None:
        """Wait for no picture's moment any more: times in a film may have a gap of hours."""
        self._stopped.set()

    def close(self) -> None:
        """Close the file."""
        self._film.release()

    def _first_again(self) -> np.ndarray | None:
        """The first picture once more, due a step behind the last one; None where the file is gone."""
        self._film.release()
        self._before_s = self._next_s
        film = opened(str(self._path), cv2.CAP_FFMPEG)  # to seek back is not sure in all containers
        if film is None:
            return None
        self._film = film
        return grabbed(film)
