"""What is asked of a webcam behind its name, ``0,size=400x400,fps=120``, and how each of OpenCV's backends is asked."""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, fields, replace

import cv2

from facegen.formats.picture_size import MOST_PIXELS
from track.errors import CameraError

_SUFFIX = re.compile(r"(?:,\s*[A-Za-z]+\s*=[^,=]*)+,?\s*\Z")

_AUTO = "auto"

_FASTEST_FPS, _LONGEST_S = 1000.0, 10.0


@dataclass(frozen=True, kw_only=True)
class CameraMode:
    """A mode of a webcam; what is None is left as the camera has it.

    Parameters
    ----------
    size
        Width and height of its pictures.
    fps
        Pictures a second.
    format
        Four letters of how pictures come over the cable, as MJPG, YUYV or GREY.
    exposure
        Seconds that each picture is exposed for, or ``"auto"``.
    gain
        As the camera counts it.
    """

    size: tuple[int, int] | None = None
    fps: float | None = None
    format: str | None = None
    exposure: float | str | None = None
    gain: float | None = None

    def __bool__(self) -> bool:
        return any(getattr(self, each.name) is not None for each in fields(self))

    def said(self, key: str) -> str:
        """One of its settings as it may be written."""
        value = getattr(self, key)
        if key == "size":
            return f"size={value[0]}x{value[1]}"
        if key == "format":
            return f"format={value.strip()}"
        if key == "exposure" and value != _AUTO:
            return f"exposure={1000 * value:g}ms"
        return f"{key}={value}" if isinstance(value, str) else f"{key}={value:g}"


def split_mode(text: str) -> tuple[str, CameraMode]:
    """A webcam and the mode that stands behind it; one that asks for nothing where none does.

    Commas of a name or an address are its own: behind the first one that begins a mode every word must be a setting.

    Raises
    ------
    CameraError
        Where a setting is not known, stands twice, or has no value that a camera can have.
    """
    # a password may look like settings, and stands before the last @ of an address
    found = _SUFFIX.search(text, text.rfind("@") + 1 if "://" in text else 0)
    if found is None:
        return text, CameraMode()
    camera = text[: found.start()]
    settings = [word.strip() for word in found[0][1:].split(",")]
    words = [[side.strip() for side in word.split("=")] for word in settings if word]
    words = [[key.lower(), written] for key, written in words]
    if not camera.isdecimal() and not any(key in _READERS for key, _ in words):
        return text, CameraMode()
    mode = CameraMode()
    for key, written in words:
        if key not in _READERS:
            raise CameraError(f"{key}={written} is no setting of a camera; {', '.join(_READERS)} are")
        if getattr(mode, key) is not None:
            raise CameraError(f"{key}={written} is the second {key} of one camera; give one")
        read, allowed = _READERS[key]
        value = read(written)
        if value is None:
            raise CameraError(f"{key}={written} can be asked of no camera; {allowed}")
        mode = replace(mode, **{key: value})
    return camera, mode


def ask_for(mode: CameraMode, capture: cv2.VideoCapture) -> list[str]:
    """Set a camera that was opened and not yet read.

    Returns
    -------
    list of str
        What it says it does not take, as it may be written; of size and rate its pictures tell.
    """
    if not mode:
        return []
    backend = capture.getBackendName()
    steps = _steps(mode, backend)
    # a width alone may be refused as long as the old height stands: the last answer counts
    taken = {name: bool(capture.set(name, value)) for name, value in steps}
    refused = []
    for key in ("format", "exposure", "gain"):
        names = [name for name, _ in _steps(CameraMode(**{key: getattr(mode, key)}), backend)]
        if getattr(mode, key) is not None and not (names and all(taken[name] for name in names)):
            refused.append(mode.said(key))
    return refused


def _steps(mode: CameraMode, backend: str) -> list[tuple[int, float]]:
    """OpenCV's properties and their values, in the order in which a backend heeds them."""
    size, fps, fourcc, light = [], [], [], []
    if mode.size is not None:
        size = list(zip((cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT), mode.size, strict=True))
    if mode.fps is not None:
        fps = [(cv2.CAP_PROP_FPS, mode.fps)]
    if mode.format is not None:
        fourcc = [(cv2.CAP_PROP_FOURCC, cv2.VideoWriter.fourcc(*mode.format))]
    windows = backend in ("DSHOW", "MSMF")
    if mode.exposure == _AUTO:
        light = [(cv2.CAP_PROP_AUTO_EXPOSURE, 1 if windows else 3)]
    elif mode.exposure is not None:
        # Video4Linux counts 100 us, and Windows powers of two of a second
        value = round(math.log2(mode.exposure)) if windows else max(1, round(mode.exposure * 10_000))
        light = [(cv2.CAP_PROP_AUTO_EXPOSURE, 0 if windows else 1), (cv2.CAP_PROP_EXPOSURE, value)]
    if mode.gain is not None:
        light.append((cv2.CAP_PROP_GAIN, mode.gain))
    if backend == "DSHOW":
        return [*fps, *fourcc, *size, *light]
    if backend == "MSMF":  # each of the two is negotiated alone; it converts every format by itself
        return [*size, *size, *fps, *light]
    if backend == "AVFOUNDATION":
        return size
    return [*fourcc, *size, *fps, *light]


def _size(written: str) -> tuple[int, int] | None:
    match = re.fullmatch(r"([1-9]\d{0,4})x([1-9]\d{0,4})", written, re.ASCII)
    size = (int(match[1]), int(match[2])) if match else None
    return size if size and size[0] * size[1] <= MOST_PIXELS else None


def _number(written: str, least: float, most: float) -> float | None:
    if re.fullmatch(r"\d{0,9}\.?\d{0,9}", written, re.ASCII) is None or not re.search(r"\d", written):
        return None
    return float(written) if least <= float(written) <= most else None


def _format(written: str) -> str | None:
    return written.upper().ljust(4) if re.fullmatch(r"[A-Za-z0-9]{3,4}", written) else None


def _exposure(written: str) -> float | str | None:
    if written == _AUTO:
        return _AUTO
    match = re.fullmatch(r"([\d.]+)(us|ms|s)", written, re.ASCII)
    number = _number(match[1], 0, 1e9) if match else None
    exposure_s = None if number is None else number * {"us": 1e-6, "ms": 1e-3, "s": 1.0}[match[2]]
    return exposure_s if exposure_s and exposure_s <= _LONGEST_S else None


_READERS: dict[str, tuple[Callable[[str], object], str]] = {
    "size": (_size, "give width and height, as in size=640x480"),
    "fps": (
        lambda written: _number(written, 1, _FASTEST_FPS),
        f"give pictures a second from 1 to {_FASTEST_FPS:g}",
    ),
    "format": (_format, "give its three or four letters, as in format=MJPG"),
    "exposure": (
        _exposure,
        f"give a time up to {_LONGEST_S:g}s with us, ms or s, as in exposure=5ms, or auto",
    ),
    "gain": (
        lambda written: _number(written, 0, 1e6),
        "give a number as the camera counts it, as in gain=16",
    ),
}
"""By the setting's name: what reads its value, None where it has none, and what is allowed."""
