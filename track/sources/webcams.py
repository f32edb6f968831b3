"""Webcams: which this machine has, as Linux names them and elsewhere by their numbers; and the pictures of one."""

import os
import re
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import cv2

from facegen.formats.film import FILMS
from track.errors import CameraError
from track.sources.opencv import grabbed, opened
from track.sources.source import Picture, Source

FOLDER = Path("/sys/class/video4linux")
"""Where Linux lists them."""

TRIED = 8
"""Numbers that are tried where the system gives no list."""

_DEVICE = re.compile(r"/dev/video(\d+)")


@dataclass(frozen=True, kw_only=True)
class Webcam:
    """A camera.

    Parameters
    ----------
    number
        As OpenCV opens it.
    name
        As its driver calls it; ``"camera N"`` where the system does not tell.
    """

    number: int
    name: str


def list_webcams(folder: Path = FOLDER) -> list[Webcam]:
    """The cameras that the system tells of, by their numbers; elsewhere than on Linux those that open."""
    if not sys.platform.startswith("linux"):
        return [Webcam(number=number, name=f"camera {number}") for number in range(TRIED) if _opens(number)]
    webcams = []
    for entry in folder.glob("video*"):
        try:
            name = (entry / "name").read_text(encoding="utf-8", errors="replace").strip()
            webcams.append(Webcam(number=int(entry.name[5:]), name=name))
        except (OSError, ValueError):  # unplugged just now, or no camera
            continue
    return sorted(webcams, key=lambda webcam: webcam.number)


def _opens(number: int) -> bool:
    capture = opened(number, cv2.CAP_ANY)
    if capture is not None:
        capture.release()
    return capture is not None


class WebcamSource(Source):
    """The pictures of a webcam, as they come; their times are when they came, by the machine's steady clock.

    Parameters
    ----------
    wanted
        Its number, a part of its name, or on Linux its device, as /dev/video2 or /dev/v4l/by-path/…, which tells two
        cameras of one make apart. One of several nodes of one name is the first that gives a picture.

    Raises
    ------
    CameraError
        Where there is no such camera, the name fits several, or it gives no picture.
    """

    def __init__(self, wanted: str, *, folder: Path = FOLDER) -> None:
        # a list is asked for only where it is needed: elsewhere than on Linux all cameras are opened for it
        if wanted.isdecimal():
            numbers, self.title = [int(wanted)], f"camera {int(wanted)}"
        elif (number := _device_number(wanted)) is not None:
            numbers, self.title = [number], wanted
        else:
            numbers, self.title = _numbers(wanted, list_webcams(folder))
        for number in numbers:
            self._capture = opened(number, cv2.CAP_ANY)
            if self._capture is None:
                continue
            self._first = grabbed(self._capture)
            if self._first is not None:
                return
            self._capture.release()
        raise CameraError(_why_not(wanted, folder))

    def read(self) -> Picture | None:
        """The next picture; None where the camera has gone."""
        pixels, self._first = (grabbed(self._capture) if self._first is None else self._first), None
        return None if pixels is None else Picture(time_s=time.perf_counter(), pixels=pixels)

    def close(self) -> None:
        """Let others have the camera."""
        self._capture.release()


def _device_number(wanted: str) -> int | None:
    """The number of a device's file on Linux, by whatever name; None of anything else."""
    found = _DEVICE.fullmatch(os.path.realpath(wanted)) if wanted.startswith("/dev/") else None
    return None if found is None else int(found[1])


def _numbers(wanted: str, webcams: list[Webcam]) -> tuple[list[int], str]:
    """Numbers to try for a part of a name, and a title."""
    fitting = [webcam for webcam in webcams if wanted.lower() in webcam.name.lower()]
    names = sorted({webcam.name for webcam in fitting})
    if len(names) > 1:
        raise CameraError(
            f"{wanted!r} is in the names of several cameras: {', '.join(names)}; give more of one"
        )
    return [webcam.number for webcam in fitting], names[0] if names else wanted


def _why_not(wanted: str, folder: Path) -> str:
    if wanted.isdecimal() and not sys.platform.startswith("linux"):
        return f"camera {wanted} gives no picture, or there is none of this number; `track devices` lists those that do"
    webcams = list_webcams(folder)
    number = wanted if (device := _device_number(wanted)) is None else str(device)
    known = any(number == str(webcam.number) or wanted.lower() in webcam.name.lower() for webcam in webcams)
    if not known and device is None and (Path(wanted).suffix.lower() in FILMS or len(Path(wanted).parts) > 1):
        return f"there is no file {wanted}; give a film or a folder of pictures that is there, or a webcam's number"
    if not webcams:
        return f"there is no camera {wanted} here, nor a file of this name; plug one in, or say --camera FILM"
    listed = ", ".join(f"{webcam.number} ({webcam.name})" for webcam in webcams)
    if known:
        return f"camera {wanted} gives no picture: another program may be using it; cameras here: {listed}"
    return f"there is no camera {wanted}, nor a file of this name; cameras here: {listed}"
