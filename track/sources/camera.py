"""Reads one source in a thread of its own, keeps its newest pictures, and opens it again when it went away."""

import math
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from enum import Enum

from track.errors import InputError
from track.sources.backlog import Backlog
from track.sources.faults import CameraFault, PictureWatch
from track.sources.source import Picture, Source

PAUSES_S = (0.5, 1.0, 2.0, 4.0, 8.0)
"""Before each try to open a camera that went away; the last one again and again."""

SILENT_S = 1.0
"""Without a picture for longer a camera is said to give none: those in the dark still give five a second."""

_STEP_S = 1 / 30
"""Between two pictures whose times do not rise, where nothing is known of the camera's rate."""

_LATEST_S = 1e10
"""Of a first time: seconds since 1970 are 2e9."""

_FARTHEST_S = 24 * 3600.0
"""A time that is farther ahead is no picture's: the clock was set."""

Opener = Callable[[], Source]


class Camera:
    """One source behind a thread. What others read of it is guarded by the lock of ``news``.

    Parameters
    ----------
    opener
        Opens the source, now and whenever it went away.
    news
        Notified of every picture, every fault and every end; one for all cameras of a capture.
    pauses_s
        As `PAUSES_S`.

    Attributes
    ----------
    waiting
        Pictures that nobody took, at times that rise; pixels are None where they are of no use.
    came_s
        When the last picture came, by ``time.perf_counter``.
    fault
        What is wrong just now.
    ended
        Whether nothing more will come.
    error
        Why, where it ended by one: lines that hold no points.
    """

    def __init__(
        self, opener: Opener, news: threading.Condition, *, pauses_s: tuple[float, ...] = PAUSES_S
    ) -> None:
        self._opener, self._news, self._pauses_s = opener, news, pauses_s
        self._source = opener()
        self.title, self.live, self.endless = self._source.title, self._source.live, self._source.endless
        self.mark, self.length_s = self._source.mark, self._source.length_s
        self.waiting = Backlog(self._source.step_s)
        self.fault: Enum | None = None
        self.ended = False
        self.error: InputError | None = None
        self.came_s = time.perf_counter()
        self._clock = RisingClock()
        self._watch = PictureWatch(moving=self.endless)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name=f"camera {self.title}", daemon=True)

    def start(self) -> None:
        """Begin to read."""
        self._thread.start()

    def take(self) -> Picture:
        """The first picture that waits, once."""
        picture = self.waiting.take()
        self._news.notify_all()
        return picture

    def now_s(self) -> float:
        """What the clock of its pictures' times shows, which goes on where the source's own was set."""
        return self._source.now_s() + self._clock.added_s

    def trouble(self) -> Enum | None:
        """What is wrong with it, that it gives nothing included."""
        silent = self.endless and time.perf_counter() - self.came_s > SILENT_S
        return CameraFault.SILENT if self.fault is None and silent else self.fault

    def stop(self) -> None:
        """Let the thread end soon, without waiting for it: of several cameras all are told before one is waited for."""
        self._stop.set()
        with self._news:
            self._news.notify_all()
        self._source.stop()

    def close(self) -> None:
        """Let the source go; the thread has ended when this returns."""
        self.stop()
        if self._thread.is_alive():
            self._thread.join(self._source.ends_within_s)
        else:
            self._source.close()

    def _run(self) -> None:
        try:
            self._read_on()
        except InputError as error:
            self.error = error
        finally:
            self._source.close()
            with self._news:
                self.ended = True
                self._news.notify_all()

    def _read_on(self) -> None:
        tries = 0
        while not self._stop.is_set():
            picture = self._source.read()
            if picture is not None:
                tries = 0
                self._keep(picture)
            elif self.endless:
                self._open_again(tries)
                tries += 1
            else:
                break

    def _keep(self, picture: Picture) -> None:
        time_s, disorder = self._clock.step(picture.time_s)
        useless = self._watch.step(picture)
        fault = useless or picture.fault or (CameraFault.DISORDER if disorder else None)
        picture = replace(picture, time_s=time_s, fault=fault, pixels=None if useless else picture.pixels)
        with self._news:
            while not self.live and self.waiting and not self._stop.is_set():
                self._news.wait()
            self.came_s, self.fault = time.perf_counter(), fault
            self.waiting.add(picture, self.came_s)
            self._news.notify_all()

    def _open_again(self, tries: int) -> None:
        """Wait for the camera, with growing pauses between tries."""
        self._source.close()
        with self._news:
            self.waiting.clear()
            self.fault = CameraFault.UNPLUGGED
            self._news.notify_all()
        while not self._stop.wait(self._pauses_s[min(tries, len(self._pauses_s) - 1)]):
            try:
                self._source = self._opener()
                self._watch = PictureWatch(moving=self.endless)
                return
            except InputError:
                tries += 1


class RisingClock:
    """Makes times rise strictly: one that goes back is taken for a clock that was set, and all after it go with it.

    Attributes
    ----------
    added_s
        By how much the times now given are later than those told.
    """

    def __init__(self) -> None:
        self._last_s: float | None = None
        self._step_s, self.added_s = _STEP_S, 0.0

    def step(self, time_s: float) -> tuple[float, bool]:
        """The next time, and whether the one that was told is wrong; one that is not known is made."""
        given_s = time_s + self.added_s
        if self._last_s is None and abs(given_s) < _LATEST_S:
            self._last_s = given_s
            return given_s, False
        last_s = 0.0 if self._last_s is None else self._last_s
        told = last_s < given_s < last_s + _FARTHEST_S
        if told:
            self._step_s, self._last_s = min(given_s - last_s, _STEP_S), given_s
        else:
            self._last_s = last_s + self._step_s
            if math.isfinite(time_s):
                self.added_s = self._last_s - time_s
        return self._last_s, not (told or math.isnan(time_s))
