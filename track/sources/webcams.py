"""Webcams: which this machine has, as Linux names them and elsewhere by their numbers; and the pictures of one."""

import re
import sys
import time
from functools import partial
from pathlib import Path

import cv2
import numpy as np

from track.errors import CameraError
from track.sources.camera_memory import CameraMemory
from track.sources.camera_mode import ask_for
from track.sources.grey_depth import grey_depth
from track.sources.mac_permission import opened_with_permission
from track.sources.node_faults import is_mute
from track.sources.opencv import grabbed, opened
from track.sources.picture_rate import RateWatch
from track.sources.source import Picture, Source
from track.sources.video_nodes import (
    FOLDER,
    Webcam,
    device_number,
    identity_of,
    is_numbered,
    lasting_identity,
    number_of,
    numbers_of,
)
from track.sources.webcam_refusals import why_not

TRIED = 8
"""Numbers that are tried where the system gives no list."""

_SLOW = 0.8
"""Share of the rate that was asked, below which it is told."""

AGAIN_S = 0.5
"""Reads that give nothing are repeated for so long before a camera counts as gone: drivers lose a picture."""

OPENING_S = 3.0
"""The same of a camera that was just opened: some need seconds to their first picture."""

_SERIAL = re.compile(r"/dev/(?:tty|cu\.).*|COM\d+", re.IGNORECASE)
"""Serial ports, as boards have them that send pictures by their programming cable."""

_PAUSE_S = 0.02
"""Between two such reads."""


def list_webcams(folder: Path = FOLDER) -> list[Webcam]:
    """The cameras that the system tells of, by their numbers; elsewhere than on Linux those that open."""
    if not sys.platform.startswith("linux"):
        return [Webcam(number=number, name=f"camera {number}") for number in range(TRIED) if _opens(number)]
    webcams = []
    for entry in folder.glob("video*"):
        try:
            name = (entry / "name").read_text(encoding="utf-8", errors="replace").strip()
            webcam = Webcam(number=int(entry.name[5:]), name=name)
        except (OSError, ValueError):  # unplugged just now, or no camera
            continue
        if not is_mute(webcam.number):
            webcams.append(webcam)
    return sorted(webcams, key=lambda webcam: webcam.number)


def _opens(number: int) -> bool:
    capture = opened(number, _backend(number))
    if capture is not None:
        capture.release()
    return capture is not None


def _backend(number: int) -> int:
    """OpenCV takes the hundreds of a number for a backend, where none is named."""
    return cv2.CAP_V4L2 if sys.platform.startswith("linux") and number >= 100 else cv2.CAP_ANY


class WebcamSource(Source):
    """The pictures of a webcam, as they come; their times are when they came, by the machine's steady clock.

    Parameters
    ----------
    wanted
        Its number, a part of its name, or on Linux its device, as /dev/video2 or /dev/v4l/by-path/…, which tells two
        cameras of one make apart. One of several nodes of one name is the first that gives a picture.
    memory
        Of this camera, where it may be opened again.

    Raises
    ------
    CameraError
        Where there is no such camera, the name fits several, or it gives no picture.
    """

    def __init__(self, wanted: str, *, folder: Path = FOLDER, memory: CameraMemory | None = None) -> None:
        self._memory, self._rate, self._stopped = memory or CameraMemory(), RateWatch(), False
        if _SERIAL.fullmatch(wanted):
            raise CameraError(
                f"{wanted} is a serial port, and pictures of serial boards are not read; give the board a program that "
                "sends MJPEG over Wi-Fi (--camera http://ADDRESS:81/stream) or makes it a USB webcam"
            )
        # a list is asked for only where it is needed: elsewhere than on Linux all cameras are opened for it
        if (number := number_of(wanted)) is not None:
            numbers = [number]
            self.title = f"camera {number}" if wanted.isdecimal() else wanted
        else:
            numbers, self.title = _numbers(wanted, list_webcams(folder))
        for number in self._same(numbers, wanted, folder):
            if opened_with_permission(partial(self._open, number), self.title, self._memory):
                self._remember(number, folder)
                return
        raise CameraError(why_not(wanted, partial(list_webcams, folder)))

    def read(self) -> Picture | None:
        """The next picture; None where the camera has gone."""
        pixels, self._first = (self._grabbed(AGAIN_S) if self._first is None else self._first), None
        if pixels is None:
            return None
        time_s = time.perf_counter()
        if self._memory.mode.fps is not None:
            self._tell_rate(self._rate.step(time_s))
        return Picture(time_s=time_s, pixels=pixels)

    def stop(self) -> None:
        """Let a `read` give up."""
        self._stopped = True

    def _same(self, numbers: list[int], wanted: str, folder: Path) -> list[int]:
        """Of a camera that was open before: the numbers at which it is now, and not those of another camera."""
        known = self._memory.identity
        identities = [identity_of(number, folder) for number in numbers]
        sockets = {identity.socket for identity in identities if identity is not None}
        if not self._memory.opened:
            self._memory.twins = len(sockets) > 1
        if known is None or (not is_numbered(wanted) and device_number(wanted) is not None):
            return numbers  # a name of the system's own, as by-path, follows the camera or the socket that it names
        found = numbers_of(known, folder)
        if found:
            return found
        if not is_numbered(wanted) and len(sockets) < 2 and not self._memory.twins:
            return numbers  # the only camera of this name, at another socket
        if sockets:
            self._memory.tell(
                "identity",
                f"{self.title} was {known.name!r}, and another camera or another socket has its place now; plug it in "
                "where it was, or end track and start it again",
            )
        return []

    def _open(self, number: int) -> bool:
        """Open a camera in its mode and wait for its first picture; it is let go where none comes."""
        self._capture = opened(number, _backend(number))
        if self._capture is None:
            return False
        refused = ask_for(self._memory.mode, self._capture)
        self._grey = grey_depth(self._capture)
        self._first = self._grabbed(OPENING_S)
        if self._first is None:
            self._capture.release()
            return False
        self._tell_mode(refused)
        return True

    def _remember(self, number: int, folder: Path) -> None:
        """Which camera it is, so that no other takes its place when it comes back."""
        memory = self._memory
        if sys.platform.startswith("linux"):
            memory.identity = memory.identity or lasting_identity(number, folder)
        elif memory.opened:
            memory.tell(
                "number",
                f"{self.title} is back by its number, and this system does not tell whether it is the same camera; "
                "look at its picture",
            )
        memory.opened = True

    def _grabbed(self, within_s: float) -> np.ndarray | None:
        """The next picture; None where none came for so long."""
        until_s = time.perf_counter() + within_s
        while True:
            pixels = grabbed(self._capture)
            if self._grey is not None and pixels is not None:
                pixels = self._grey.step(pixels)
            if pixels is not None or self._stopped or time.perf_counter() >= until_s:
                return pixels
            time.sleep(_PAUSE_S)

    def close(self) -> None:
        """Let others have the camera."""
        self._capture.release()

    def _tell_mode(self, refused: list[str]) -> None:
        """What of the mode the camera does not do, by its first picture: what drivers answer is often only asked."""
        size = self._memory.mode.size
        if refused:
            self._memory.tell(
                "mode", f"{self.title} does not take {' and '.join(refused)}; it goes on without"
            )
        height, width = self._first.shape[:2]
        if size is not None and size != (width, height):
            self._memory.tell(
                "size",
                f"{self.title} gives {width}x{height} where {size[0]}x{size[1]} was asked; ask for a size that it has, "
                "which may need another format",
            )

    def _tell_rate(self, fps: float | None) -> None:
        asked_fps = self._memory.mode.fps
        if fps is not None and fps < _SLOW * asked_fps:
            self._memory.tell(
                "rate",
                f"{self.title} gives {fps:.0f} pictures a second where {asked_fps:g} were asked; a shorter exposure, "
                "more light, format=MJPG or a smaller size may help",
            )


def _numbers(wanted: str, webcams: list[Webcam]) -> tuple[list[int], str]:
    """Numbers to try for a part of a name, and a title."""
    fitting = [webcam for webcam in webcams if wanted.lower() in webcam.name.lower()]
    names = sorted({webcam.name for webcam in fitting})
    if len(names) > 1:
        raise CameraError(
            f"{wanted!r} is in the names of several cameras: {', '.join(names)}; give more of one"
        )
    return [webcam.number for webcam in fitting], names[0] if names else wanted
