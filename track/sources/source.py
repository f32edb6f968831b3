"""The one interface of a camera's pictures, live or kept, and the one record that it gives."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True, eq=False)
class Picture:
    """One picture of one camera.

    Parameters
    ----------
    time_s
        When it was taken, in seconds of the source's own clock; it rises from picture to picture.
    pixels : (h, w, 3) uint8, blue green red, or (h, w) uint8
        As OpenCV gives it.
    """

    time_s: float
    pixels: np.ndarray


class Source:
    """A camera; `read` waits for the next picture.

    Attributes
    ----------
    title
        What a person calls it: ``"camera 0"``, a file's name, an address without its password.
    live
        Whether pictures come by themselves: a live source loses what nobody read, a kept one waits.
    """

    title: str
    live: bool

    def read(self) -> Picture | None:
        """The next picture; None where there are no more: a film's end, a camera that was unplugged."""
        raise NotImplementedError

    def close(self) -> None:
        """Let the camera go; a source can be opened again by making another one."""
