"""Linux' nodes of video, /dev/videoN: which camera is behind one, whatever its number is today."""

import os
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
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
    """What stays of a camera that is unplugged and plugged in again, while its number may change.

    Parameters
    ----------
    socket
        The device's place in the tree of buses; a camera of the same make at another socket has another one, and so has
        the same camera where a loose USB 3 plug makes it one of USB 2.
    name
        As its driver calls it.
    index
        Which of the device's nodes it is.
    serial
        As the camera gives it; empty where it gives none, or others of its make have the same one.
    """

    socket: str
    name: str
    index: str
    serial: str = ""


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
    socket = os.path.realpath(node / "device")
    try:
        serial = (Path(socket).parent / "serial").read_text(encoding="utf-8", errors="replace").strip()
    except OSError:
        serial = ""
    return Identity(socket=socket, name=name, index=index, serial=serial)


def lasting_identity(number: int, folder: Path = FOLDER) -> Identity | None:
    """The same to be kept: with a serial number only where no other camera has it, as of cheap ones all have one."""
    identity = identity_of(number, folder)
    if identity is None or len(_numbers_where(folder, lambda each: _serial(each) == _serial(identity))) == 1:
        return identity
    return replace(identity, serial="")


def numbers_of(identity: Identity, folder: Path = FOLDER) -> list[int]:
    """The numbers that a camera has now: one, or none while it is away.

    It is where it was, or, as the only one of its make and serial number, anywhere.
    """
    found = _numbers_where(folder, lambda each: _place(each) == _place(identity))
    if found or not identity.serial:
        return found
    moved = _numbers_where(folder, lambda each: _serial(each) == _serial(identity))
    return moved if len(moved) == 1 else []


def _numbers_where(folder: Path, test: Callable[[Identity], bool]) -> list[int]:
    numbers = [int(node.name[5:]) for node in folder.glob("video*") if node.name[5:].isdecimal()]
    known = {number: identity_of(number, folder) for number in sorted(numbers)}
    return [number for number, identity in known.items() if identity is not None and test(identity)]


def _place(identity: Identity) -> tuple[str, str, str]:
    return identity.socket, identity.name, identity.index


def _serial(identity: Identity) -> tuple[str, str, str]:
    return identity.serial, identity.name, identity.index


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
