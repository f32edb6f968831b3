"""Linux' nodes of video, /dev/videoN: which camera is behind one, whatever its number is today."""

import os
import re
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path("/sys/class/video4linux")
"""Where Linux lists them."""

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


@dataclass(frozen=True, kw_only=True)
class Identity:
    """What stays of a camera that is unplugged and plugged into the same socket, while its number may change.

    Parameters
    ----------
    socket
        The device's place in the tree of buses; a camera of the same make at another socket has another one.
    name
        As its driver calls it.
    index
        Which of the device's nodes it is.
    """

    socket: str
    name: str
    index: str


def identity_of(number: int, folder: Path = FOLDER) -> Identity | None:
    """Which camera a number is now; None where the system does not tell, as of cameras that a program makes."""
    node = folder / f"video{number}"
    try:
        name = (node / "name").read_text(encoding="utf-8", errors="replace").strip()
        index = (node / "index").read_text(encoding="utf-8").strip() if (node / "index").exists() else ""
    except OSError:
        return None
    if not (node / "device").exists():
        return None
    return Identity(socket=os.path.realpath(node / "device"), name=name, index=index)


def numbers_of(identity: Identity, folder: Path = FOLDER) -> list[int]:
    """The numbers that a camera has now: one, or none while it is away."""
    numbers = [int(node.name[5:]) for node in folder.glob("video*") if node.name[5:].isdecimal()]
    return sorted(number for number in numbers if identity_of(number, folder) == identity)


def device_number(wanted: str) -> int | None:
    """The number of a device's file, by whatever name; None of anything else."""
    found = _DEVICE.fullmatch(os.path.realpath(wanted)) if wanted.startswith("/dev/") else None
    return None if found is None else int(found[1])


def is_numbered(wanted: str) -> bool:
    """Whether a text names a camera by nothing but its number, which another one may have tomorrow."""
    return wanted.isdecimal() or _DEVICE.fullmatch(wanted) is not None


def number_of(wanted: str) -> int | None:
    """The number that a text is, or whose device it names; None of a part of a camera's name."""
    return int(wanted) if wanted.isdecimal() else device_number(wanted)


def same_camera(one: str, other: str) -> bool:
    """Whether two texts mean one webcam, as far as their letters tell: 0 is /dev/video0."""
    return one == other or (number_of(one) is not None and number_of(one) == number_of(other))
