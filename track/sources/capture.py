"""Makes samples of cameras: one picture of each, paired by their times, and the newest ones for a slow reader."""

import threading
import time
from collections.abc import Iterator, Mapping
from enum import Enum

import numpy as np

from regress.runtime.headset.pictures.halves import half_of
from regress.runtime.sample import Sample
from track.sources.backlog import LONGEST_S, of_one_moment
from track.sources.camera import PAUSES_S, Camera, Opener
from track.sources.faults import CameraFault
from track.sources.source import Picture

EMPTY_AFTER_S = 0.25
"""Without a picture for longer a sample without pictures comes, so that who waits can tell: 5 pictures a second, as
webcams give in the dark, are 0.2 s apart."""

EMPTY_AFTER_STEPS, EMPTY_WITHIN_S = 1.6, 2.0
"""Of a slower camera: so many times its step, and no later. An ESP32's board gives two or three pictures a second, and
a face that was gone between each two of them would hardly move."""

WAIT_S = 0.02
"""For the other cameras, once one has a new picture; and how far apart pictures of films are, at most, that go
together."""

LATE_S = 0.1
"""Older pictures do not go with the newest one: eyes and mouth would be of two faces. Those of a slow camera do until
its next one is due, and of one whose pictures come in bursts until the next burst."""

_LOOK_EVERY_S = 0.25
"""By which a wait sees that it was stopped; Windows gives a signal no other chance."""

_LEAST_S = 1e-6


class Capture:
    """Cameras behind threads, which keep the newest pictures only; films that are not live wait and lose none.

    Use as a context manager, or call `close`: no thread survives it.

    Parameters
    ----------
    openers
        What opens each camera, by the camera's name.
    halves
        Cameras of the samples that are halves of these cameras' pictures, by name: of which camera, and which half. All
        cameras as they are, without.
    pauses_s
        As `track.sources.camera.PAUSES_S`.

    Raises
    ------
    CameraError
        Where a camera cannot be opened at the start; later it is a fault.

    Attributes
    ----------
    titles
        What a person calls each camera, by its name.
    keys
        What each camera's profile is called after, by its name.
    live
        Whether pictures come by themselves.
    endless
        Whether any is a camera, which has no end.
    length_s
        How long all films last; None where one has no end, or does not say when.
    """

    def __init__(
        self,
        openers: Mapping[str, Opener],
        *,
        halves: Mapping[str, tuple[str, str]] | None = None,
        pauses_s: tuple[float, ...] = PAUSES_S,
    ) -> None:
        self._news = threading.Condition()
        self._cameras: dict[str, Camera] = {}
        try:
            for name, opener in openers.items():
                self._cameras[name] = Camera(opener, self._news, pauses_s=pauses_s)
        except BaseException:
            self.close()
            raise
        self._halves = dict(halves or {name: (name, "") for name in openers})
        self._seen: dict[str, tuple[np.ndarray, np.ndarray]] = {}
        self.titles = {
            name: self._cameras[whole].title + (f"#{half}" if half else "")
            for name, (whole, half) in self._halves.items()
        }
        self.keys = {
            name: f"{self.titles[name]} {mark}" if (mark := self._cameras[whole].mark) else self.titles[name]
            for name, (whole, _) in self._halves.items()
        }
        self.live = any(camera.live for camera in self._cameras.values())
        lengths_s = [camera.length_s for camera in self._cameras.values()]
        self.length_s = None if None in lengths_s else max(lengths_s, default=None)
        self.endless = any(each.endless for each in self._cameras.values())
        # a machine's clock counts from its start, a film's from the film's
        self._start_s = time.perf_counter() if self.endless else 0.0
        self._latest: dict[str, Picture] = {}
        self._last_s, self._count = -np.inf, 0
        self._caught_up_s = -np.inf
        self._stopped = False
        for camera in self._cameras.values():
            camera.start()

    def __enter__(self) -> "Capture":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __iter__(self) -> Iterator[Sample]:
        while (sample := self.read()) is not None:
            yield sample

    def read(self, within_s: float | None = None) -> Sample | None:
        """The next moment, as soon as there is one; None where all films are over, or `stop` was called.

        Parameters
        ----------
        within_s
            How long live cameras are waited for; `EMPTY_AFTER_S` by default, and longer for slow ones.

        Returns
        -------
        Sample or None
            Its pictures are those that can be used; its faults say by camera why others cannot. Where live cameras give
            nothing for so long it has no pictures.

        Raises
        ------
        InputError
            Where what comes is not what it should be, as standard input without points.
        """
        until_s = time.perf_counter() + (self._empty_after_s() if within_s is None else within_s)
        with self._news:
            while True:
                self._raise_errors()
                if self._stopped or self.over:
                    return None
                wait_s = self._wait_s(until_s) if self.live else self._wait_for_all_s()
                if wait_s is not None and wait_s <= 0:
                    return self._sample()
                caught_up = not any(camera.waiting for camera in self._cameras.values())
                self._news.wait(_LOOK_EVERY_S if wait_s is None else min(wait_s, _LOOK_EVERY_S))
                if caught_up:
                    self._caught_up_s = time.perf_counter()

    def now_s(self) -> float:
        """What the clock of the samples' times shows now: less a sample's time, how old it is."""
        return max(camera.now_s() for camera in self._cameras.values()) - self._start_s

    @property
    def over(self) -> bool:
        """Whether every picture of all cameras was taken, and no other one can come."""
        return all(camera.ended and not camera.waiting for camera in self._cameras.values())

    def stop(self) -> None:
        """Let `read` give nothing more; from any thread or signal, which may not wait for a lock."""
        self._stopped = True

    def close(self) -> None:
        """Let all cameras go: they are told first, so that silent ones are waited for together."""
        for camera in self._cameras.values():
            camera.stop()
        for camera in self._cameras.values():
            camera.close()

    def _raise_errors(self) -> None:
        for camera in self._cameras.values():
            if camera.error is not None and not camera.waiting:
                raise camera.error

    def _wait_s(self, until_s: float) -> float:
        """How long a moment of live cameras is still waited for."""
        new = [camera for camera in self._cameras.values() if camera.waiting]
        if new and not self._awaited():
            return 0.0
        if new:
            until_s = min(camera.waiting.came_s for camera in new) + WAIT_S
        return until_s - time.perf_counter()

    def _empty_after_s(self) -> float:
        """By the quickest camera that is well."""
        well = [each for each in self._cameras.values() if not each.ended and each.trouble() is None]
        return _patience_s(min((each.waiting.gap_s for each in well), default=np.inf), EMPTY_AFTER_S)

    def _awaited(self) -> bool:
        """Whether a camera has no picture yet from which one is expected that goes with those that are there."""
        cameras, now_s = self._cameras.values(), time.perf_counter()
        until_s = min(each.waiting.came_s + each.waiting.together_s for each in cameras if each.waiting)
        return any(
            not (each.waiting or each.ended or each.trouble())
            and each.waiting.due_s <= until_s
            and (np.isinf(each.waiting.due_s) or now_s < each.waiting.due_s + WAIT_S)
            for each in cameras
        )

    def _wait_for_all_s(self) -> float | None:
        """The same of films that wait: None is as long as it takes."""
        return 0.0 if all(camera.waiting or camera.ended for camera in self._cameras.values()) else None

    def _next(self) -> list[str]:
        """Names of cameras whose first pictures make the next sample; the newest ones, for a reader who is behind."""
        waiting = {name: camera.waiting for name, camera in self._cameras.items() if camera.waiting}
        if not waiting:
            return []
        if not self.live:
            first = min(waiting.values(), key=lambda each: each.time_s)
            latest_s = first.time_s + min(WAIT_S, first.together_s)
            return [name for name, each in waiting.items() if each.time_s <= latest_s]
        behind = time.perf_counter() - self._caught_up_s > LONGEST_S
        if behind:
            for each in waiting.values():
                each.leave_newest()
            return list(waiting)
        return of_one_moment(waiting)

    def _sample(self) -> Sample:
        """A sample of the pictures that are next, and of those before that are not too old."""
        taken = {name: self._cameras[name].take() for name in self._next()}
        self._latest |= taken
        newest_s = max((each.time_s for each in self._latest.values()), default=0.0)
        now_s = max(each.time_s for each in taken.values()) - self._start_s if taken else self.now_s()
        self._last_s = max(now_s, self._last_s + _LEAST_S)
        self._count += 1
        pictures, faults = {}, {}
        for name, (whole, half) in self._halves.items():
            camera, latest = self._cameras[whole], self._latest.get(whole)
            fault = taken[whole].fault if whole in taken else camera.trouble()
            late_s = _patience_s(camera.waiting.gap_s, LATE_S)
            late = taken and latest and newest_s - latest.time_s > late_s
            if fault is None and late and not camera.ended:
                fault = CameraFault.LATE
            if fault is not None:
                faults[name] = fault
            if taken and latest and not late and latest.pixels is not None and _usable(fault):
                pictures[name] = self._half(name, latest.pixels, half)
        points = next((each for each in taken.values() if each.points is not None), None)
        return Sample(
            label=str(self._count),
            time_s=float(self._last_s),
            pictures=pictures,
            points=None if points is None else points.points,
            irises=None if points is None else points.irises,
            faults=faults,
        )

    def _half(self, name: str, pixels: np.ndarray, half: str) -> np.ndarray:
        """A camera's part of a picture: the same array for the same picture."""
        if name not in self._seen or self._seen[name][0] is not pixels:
            self._seen[name] = pixels, half_of(pixels, half)
        return self._seen[name][1]


def _patience_s(gap_s: float, usual_s: float) -> float:
    """How long a camera's next picture is waited for: longer than usual, where it gives few, or many at once."""
    if not np.isfinite(gap_s):
        return usual_s
    return float(np.clip(EMPTY_AFTER_STEPS * gap_s, usual_s, EMPTY_WITHIN_S))


def _usable(fault: Enum | None) -> bool:
    """Whether a picture's camera can be believed: a clock that was set spoils no picture."""
    return fault is None or fault is CameraFault.DISORDER
