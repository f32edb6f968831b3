"""Reads the frames of a film, one by one, with the times that it gives them."""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import cv2
import numpy as np

from facegen.formats.film import check_film_path
from facegen.formats.picture_size import MOST_PIXELS
from regress.errors import InputError
from regress.runtime.even_rows import even_rows

_FEWER = 0.02
"""Share of a film's frames, and two at least, that may be lacking untold: some containers estimate their number."""

_BETWEEN = 8
"""Frames from one to the next that are looked at where a film does not say how many there are."""

_COUNTED = (".avi", ".mp4", ".m4v", ".mov", ".3gp")
"""Films that say how many frames they have. Of others OpenCV takes how long they last times their rate, which frames
that a camera dropped on the way are not lacking from: those end early whose last frame does."""

_QUIET = "-8"
"""FFmpeg's AV_LOG_QUIET: of a damaged film it writes a line a frame, and OpenCV asks once, at the first opening."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FilmFrame:
    """One frame.

    Parameters
    ----------
    number
        Counted from 0.
    time_s
        As the film tells it; containers without times tell 0 of all.
    grey : (h, w) uint8
        Its picture.
    """

    number: int
    time_s: float
    grey: np.ndarray


class Film:
    """A film whose pictures are turned as it says: telephones write them as the sensor lies.

    Use as a context manager.

    Parameters
    ----------
    path
        Of any kind that OpenCV reads.

    Attributes
    ----------
    fps
        Frames a second; None where the film does not tell.
    size
        Width and height.
    length
        How many frames there are, as it says itself; 0 where it does not.
    ended_after
        Frames after which no more came; None while more may come.
    """

    def __init__(self, path: Path) -> None:
        check_film_path(path)
        os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", _QUIET)
        self.ended_after: int | None = None
        self._last_s = 0.0
        self._path, self._film = path, cv2.VideoCapture(os.fspath(path))
        self._film.set(cv2.CAP_PROP_ORIENTATION_AUTO, 1)
        fps, length = (self._film.get(each) for each in (cv2.CAP_PROP_FPS, cv2.CAP_PROP_FRAME_COUNT))
        self.fps = fps if 0 < fps < 1000 else None
        self.length = int(length) if 0 < length < 1e9 else 0
        self.size = (
            int(self._film.get(cv2.CAP_PROP_FRAME_WIDTH)),
            int(self._film.get(cv2.CAP_PROP_FRAME_HEIGHT)),
        )

    def __enter__(self) -> "Film":
        return self

    def __exit__(self, *_: object) -> None:
        self._film.release()

    @property
    def lacking(self) -> str:
        """That frames are lacking that it says it has, in words; empty where none are."""
        fewer = max(2, _FEWER * self.length)
        if self.ended_after is None or self.length - self.ended_after <= fewer:
            return ""
        counted = self._path.suffix.lower() in _COUNTED
        if not counted and self.fps is not None and self.length - 1 - self._last_s * self.fps <= fewer:
            return ""
        return (
            f"its film says that it has {self.length} frames, and ends or cannot be decoded after {self.ended_after}; "
            f"what was read counts"
        )

    def spread(self, count: int) -> Iterator[np.ndarray]:
        """So many grey pictures all over the film, as far as it can be wound; before its frames are read.

        Of a film that does not say how long it is they are from its beginning.
        """
        if not self.length:
            yield from (frame.grey for frame in self.frames(set(range(0, count * _BETWEEN, _BETWEEN))))
            return
        for row in even_rows(self.length, count):
            self._film.set(cv2.CAP_PROP_POS_FRAMES, float(row))
            try:
                there, frame = self._film.read()
            except cv2.error:
                return
            if there:
                yield _grey(frame)

    def frames(self, chosen: set[int] | None = None) -> Iterator[FilmFrame]:
        """Frames in order: those of these numbers, or all.

        Raises
        ------
        InputError
            Where they are too large, or cannot be decoded.
        """
        width, height = self.size
        if width * height > MOST_PIXELS:
            raise InputError(
                f"{self._path} has frames of {width} x {height} pixels; at most {MOST_PIXELS:,} are read"
            )
        last = None if chosen is None else max(chosen)
        try:
            for number in count():
                if last is not None and number > last:
                    return
                if not self._film.grab():
                    self.ended_after = number
                    return
                self._last_s = self._film.get(cv2.CAP_PROP_POS_MSEC) / 1000
                if chosen is not None and number not in chosen:
                    continue
                there, frame = self._film.retrieve()
                if not there:
                    self.ended_after = number
                    return
                yield FilmFrame(
                    number=number,
                    time_s=self._last_s,
                    grey=_grey(frame),
                )
        except cv2.error as error:
            raise InputError(f"{self._path} cannot be read as a film ({error.err})") from error


def _grey(frame: np.ndarray) -> np.ndarray:
    return cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) if frame.ndim == 3 else frame
