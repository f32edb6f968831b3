"""Keeps what cameras show: a folder of pictures each, numbered by moments, and the moments' times."""

import os
import shutil
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from threading import BoundedSemaphore

import cv2
import numpy as np

from facegen.files import check_new_folder
from regress.runtime.sample import Sample
from track.errors import OutputError

TIMES = "times.csv"
"""Number and seconds of each moment."""

_WRITERS = 2
_WAITING = 64
"""Pictures that may wait to be packed: behind them the cameras' own lines lose the oldest."""

_QUICKLY = (cv2.IMWRITE_PNG_COMPRESSION, 1)


class FootageWriter:
    """Writes the pictures of samples into a new folder, each camera's into its own.

    A slow camera's picture is written once, with the number of its first moment. Use as a context manager.

    Parameters
    ----------
    folder
        To make.
    cameras
        Names of the cameras, each of which gets a folder.

    Raises
    ------
    InputError
        Where something of that name is there.
    OutputError
        Where it cannot be made.

    Attributes
    ----------
    written : dict of int
        How many pictures each camera has so far.
    """

    def __init__(self, folder: Path, cameras: Sequence[str]) -> None:
        check_new_folder(folder, what="the take")
        self._folder = folder
        try:
            folder.mkdir()
            for name in cameras:
                (folder / name).mkdir()
            self._times = (folder / TIMES).open("w", encoding="utf-8", newline="\n")
        except OSError as error:
            shutil.rmtree(folder, ignore_errors=True)
            raise OutputError(f"{folder}: cannot be made ({error.strerror})") from None
        self.written = dict.fromkeys(cameras, 0)
        self._last: dict[str, np.ndarray] = {}
        self._moments = 0
        self._pool = ThreadPoolExecutor(_WRITERS)
        self._room = BoundedSemaphore(_WAITING)
        self._errors: list[BaseException] = []
        self._times.write("frame,time_s\n")

    def __enter__(self) -> "FootageWriter":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def write(self, sample: Sample) -> None:
        """Keep what is new of a moment.

        Raises
        ------
        OutputError
            Where a picture before it could not be written.
        """
        new = {
            name: picture
            for name, picture in (sample.pictures or {}).items()
            if picture is not self._last.get(name)
        }
        if not new:
            return
        for name, picture in new.items():
            self._room.acquire()
            path = self._folder / name / f"{self._moments:06d}.png"
            self._pool.submit(_write_picture, path, picture).add_done_callback(self._done)
            self.written[name] += 1
        self._last |= new
        self._write_time(f"{self._moments},{sample.time_s:.6f}\n")
        self._moments += 1
        self._raise_errors()

    def close(self) -> None:
        """Wait until all is written; of a take without pictures nothing stays.

        Raises
        ------
        OutputError
            Where something could not be.
        """
        self._pool.shutdown()
        try:
            self._times.close()
        except OSError as error:
            self._errors.append(error)
        if not any(self.written.values()):
            shutil.rmtree(self._folder, ignore_errors=True)
        self._raise_errors()

    def _write_time(self, line: str) -> None:
        try:
            self._times.write(line)
        except OSError as error:
            self._errors.append(error)

    def _done(self, written: "Future[None]") -> None:
        self._room.release()
        error = written.exception()
        if error is not None:
            self._errors.append(error)

    def _raise_errors(self) -> None:
        if self._errors:
            error = self._errors[0]
            raise OutputError(
                f"{self._folder}: cannot be written ({getattr(error, 'strerror', None) or error})"
            )


def _write_picture(path: Path, picture: np.ndarray) -> None:
    if picture.ndim == 3 and (picture[..., :1] == picture[..., 1:]).all():
        picture = picture[..., 0]  # an infra-red camera that calls its grey levels colours
    part = path.with_suffix(".part")
    try:
        part.write_bytes(cv2.imencode(".png", picture, _QUICKLY)[1].tobytes())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)  # half of a picture, on a full disk
