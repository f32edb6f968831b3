"""Pictures of a folder, in the natural order of their names; a folder that still grows is followed.

Names that count pictures give them their times, so that one that was lost leaves its time empty.
"""

import threading
import time
from pathlib import Path

import cv2
import numpy as np

from facegen.documents import read_bytes
from facegen.formats.natural_order import natural_order
from facegen.formats.picture_size import MOST_PIXELS, picture_size
from regress.runtime.headset.pictures.picture_file import MOST_PICTURE_BYTES, PICTURES
from track.errors import CameraError, InputError
from track.sources.faults import CameraFault
from track.sources.numbering import last_number, numbers_of, pictures_in
from track.sources.source import Picture, Source

FOLLOWED_S = 2.0
"""A folder in which nothing new has appeared for longer is over."""

_LOOK_EVERY_S = 0.02


class Folder(Source):
    """A folder of pictures from the first to the last, once or over and over.

    Parameters
    ----------
    folder
        Holds files with endings of pictures; others are passed over.
    fps
        Pictures a second.
    fast
        Whether every picture is wanted, as soon as the one before has been taken; such a folder is not followed.
    again
        Whether it begins again behind its last picture, at once: new ones are not waited for, but found.
    numbers
        From the first to the last number of all folders that are read with it; its own by default.

    Raises
    ------
    CameraError
        Where it holds no picture, or one of 16 bits; `read` says so as well.
    """

    endless = False

    def __init__(
        self,
        folder: Path,
        *,
        fps: float,
        fast: bool = False,
        again: bool = False,
        numbers: range | None = None,
    ) -> None:
        self.title, self.live = folder.name or str(folder), not fast
        self._folder, self.step_s, self._again = folder, 1 / fps, again
        self._given = natural_order("")
        self._own_numbers: range | None = None
        self._waiting = self._listed()
        if not self._waiting:
            raise CameraError(f"{folder} holds no picture; files that end in {', '.join(PICTURES)} are read")
        _read_picture(self._waiting[0])  # one of 16 bits is refused before anything is written
        known = self._own_numbers is not None
        self._numbers = (numbers or self._own_numbers) if known else range(len(self._waiting))
        self._expected = self._numbers.start if known else None
        self.length_s = None if again else len(self._numbers) * self.step_s
        self._next_s = self._last_s = 0.0
        self._begun_s: float | None = None
        self._stopped = threading.Event()

    def read(self) -> Picture | None:
        """The next picture, when it is due; None where no other one has come for `FOLLOWED_S`."""
        until_s = time.perf_counter() + (FOLLOWED_S if self.live else 0.0)
        while (found := self._found(last_try=time.perf_counter() >= until_s)) is None:
            if time.perf_counter() >= until_s:
                return None
            time.sleep(_LOOK_EVERY_S)
        if self.live:
            self._stopped.wait(max(0.0, self._next_s - self.now_s()))
            if self.now_s() > self._next_s + self.step_s:  # it was not there when it was due
                self._next_s = self.now_s()
        self._last_s, self._next_s = self._next_s, self._next_s + self.step_s
        pixels = found[0]
        fault = CameraFault.UNREADABLE if pixels is None else None
        return Picture(time_s=self._last_s, pixels=pixels, fault=fault)

    def now_s(self) -> float:
        """Time since the first picture; of a fast folder, that of the picture that was read last."""
        if not self.live:
            return self._last_s
        if self._begun_s is None:
            self._begun_s = time.perf_counter()
        return time.perf_counter() - self._begun_s

    def stop(self) -> None:
        """Wait no longer for a picture behind many that were lost."""
        self._stopped.set()

    def close(self) -> None:
        """Nothing is held."""

    def _found(self, *, last_try: bool) -> tuple[np.ndarray | None] | None:
        """The next file's picture, None within for a file that is none; None where there is no file yet."""
        self._waiting = self._waiting or self._listed()
        if not self._waiting and self._again:
            self._begin_again()
        if not self._waiting:
            return None
        file = self._waiting[0]
        pixels = _read_picture(file)
        if pixels is None and self.live and len(self._waiting) == 1 and not last_try:
            return None  # the newest one may be half written
        self._given = natural_order(self._waiting.pop(0).name)
        number = None if self._own_numbers is None else last_number(file)
        self._pass_over(number)
        self._expected = None if number is None else number + 1
        return (pixels,)

    def _begin_again(self) -> None:
        """Behind the last picture of all folders, so that they stay together."""
        self._given = natural_order("")
        self._waiting = self._listed()
        if self._waiting:
            self._pass_over(self._numbers.stop)
            self._expected = None if self._expected is None else self._numbers.start

    def _pass_over(self, number: int | None) -> None:
        """Leave the time of pictures that are missing before one of this number."""
        if number is not None and self._expected is not None:
            self._next_s += max(0, number - self._expected) * self.step_s

    def _listed(self) -> list[Path]:
        """Pictures that come behind the last one that was given."""
        try:
            files = pictures_in(self._folder)
        except OSError as error:
            raise CameraError(f"{self._folder} cannot be read ({error.strerror})") from None
        self._own_numbers = numbers_of(files)
        return sorted(
            (file for file in files if natural_order(file.name) > self._given),
            key=lambda file: natural_order(file.name),
        )


def _read_picture(file: Path) -> np.ndarray | None:
    """Pixels (h, w, 3) of a file; None where it is no picture, or too large."""
    try:
        content = read_bytes(file, most_bytes=MOST_PICTURE_BYTES)
    except InputError:
        return None
    size = picture_size(content)
    if size is None or size[0] * size[1] > MOST_PIXELS:
        return None
    try:
        pixels = cv2.imdecode(np.frombuffer(content, dtype=np.uint8), cv2.IMREAD_COLOR | cv2.IMREAD_ANYDEPTH)
    except cv2.error:
        return None
    if pixels is not None and pixels.dtype != np.uint8:
        # the upper 8 bits would be black: cameras of 10 bits use the lower ones, and files do not say how many
        raise CameraError(
            f"{file} has {8 * pixels.itemsize} bits a pixel, and 8 are read here; save pictures with 8 (of 10 bits, "
            f"levels divided by 4), or give a headset's recording to `regress headset predict --bits`"
        )
    return pixels
