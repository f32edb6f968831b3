"""The one interface of a camera's pictures, live or kept, and the one record that it gives."""

import time
from dataclasses import dataclass
from enum import Enum

import numpy as np


@dataclass(frozen=True, kw_only=True, eq=False)
class Picture:
    """One picture of one camera, or the points that somebody's detector found in it.

    Parameters
    ----------
    time_s
        When it was taken, in seconds of the source's own clock (`Source.now_s`).
    pixels : (h, w, 3) uint8, blue green red, or (h, w) uint8, or None
        As OpenCV gives it; None where points came instead.
    points : (68, 2) float64 or None
    irises : (2, 2) float64 or None
        As in `regress.runtime.sample.Sample`.
    fault
        What the source itself says is wrong with it.
    """

    time_s: float
    pixels: np.ndarray | None = None
    points: np.ndarray | None = None
    irises: np.ndarray | None = None
    fault: Enum | None = None


class Source:
    """A camera; `read` waits for the next picture.

    Attributes
    ----------
    title
        What a person calls it: ``"camera 0"``, a file's name, an address without its password.
    mark
        What tells it apart from another camera of this title, and says nothing; empty where the title does.
    live
        Whether pictures come by themselves: a live source loses what nobody read, a kept one waits.
    endless
        Whether no end is foreseen: a camera that gives no more has a fault and is opened again, a film is over.
    length_s
        How long all of its pictures last; None where no end is foreseen, or nobody knows it.
    step_s
        From one picture to the next; None where only pictures will tell.
    ends_within_s
        How long `read` may go on after someone wants it closed.
    """

    title: str
    mark: str = ""
    live: bool = True
    endless: bool = True
    length_s: float | None = None
    step_s: float | None = None
    ends_within_s: float = (
        15.0  # a driver that hangs gives up after ten seconds (OpenCV's wait for Video4Linux)
    )

    def read(self) -> Picture | None:
        """The next picture; None where there are no more: a film's end, a camera that was unplugged."""
        raise NotImplementedError

    def now_s(self) -> float:
        """What the clock of the pictures' times shows now.

        All of track reads this one: on Windows before Python 3.13 `time.monotonic` stands still for 15.6 ms, so two
        pictures of a camera of 120 Hz had one time (https://github.com/python/cpython/issues/88494).
        """
        return time.perf_counter()

    def stop(self) -> None:
        """Let a `read` that waits come back soon; another thread asks for it."""

    def close(self) -> None:
        """Let the camera go; a source can be opened again by making another one."""
