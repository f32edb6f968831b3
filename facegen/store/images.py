"""Writes and reads pictures: an 8-bit grey PNG as the sensor gives it, and one multi-part EXR with what is true.

Both are made here rather than by Blender, whose files carry times: the same arrays always give the same
bytes.
"""

import errno
import os
import struct
from pathlib import Path

import cv2
import numpy as np
import OpenEXR

from facegen.documents import read_bytes
from facegen.errors import FormatError
from facegen.scene.scene import Layers

EXR_PARTS: dict[str, dict[str, type[np.generic]]] = {
    "radiance": {"Y": np.float16},
    "depth": {"Z": np.float32},
    "normal": {"X": np.float16, "Y": np.float16, "Z": np.float16},
    "part": {"id": np.uint32},
    "uv": {"U": np.float32, "V": np.float32},
}
"""Parts of an EXR file and the types of their channels; radiance comes first, for simple readers."""


MOST_PIXELS = 4096 * 16384
"""Of a picture: specs allow 4096 px of width, and no camera is four times as high."""

MOST_BYTES = 2 * MOST_PIXELS
"""Of a PNG file: noise does not become smaller, nor twice as large."""

_NO_ROOM = tuple(getattr(errno, name) for name in ("ENOSPC", "EDQUOT") if hasattr(errno, name))

_PNG = b"\x89PNG\r\n\x1a\n"


def png_bytes(grey: np.ndarray) -> bytes:
    """A PNG file of a grey picture (h, w) uint8."""
    done, encoded = cv2.imencode(".png", grey, [cv2.IMWRITE_PNG_COMPRESSION, 6])
    if not done:
        raise ValueError(f"a picture of shape {grey.shape} and type {grey.dtype} cannot be a PNG")
    return encoded.tobytes()


def read_png(path: str | Path) -> np.ndarray:
    """The grey picture (h, w) uint8 of a PNG file.

    Raises
    ------
    InputError
        Where there is no such file.
    FormatError
        Where it is no such picture, or has more than `MOST_PIXELS`.
    """
    return parse_png(read_bytes(path, most_bytes=MOST_BYTES), where=str(path))


def parse_png(content: bytes, *, where: str) -> np.ndarray:
    """The grey picture (h, w) uint8 of a PNG file's content; ``where`` begins the sentence of an error."""
    if content[:8] != _PNG or len(content) < 26 or content[12:16] != b"IHDR":
        raise FormatError(f"{where} is not an 8-bit grey PNG")
    width, height = struct.unpack(">II", content[16:24])
    _check_size(width, height, where)
    picture = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
    if picture is None or picture.ndim != 2 or picture.dtype != np.uint8:
        raise FormatError(f"{where} is not an 8-bit grey PNG")
    return picture


def _check_size(width: int, height: int, where: str) -> None:
    if not 0 < width * height <= MOST_PIXELS:
        raise FormatError(
            f"{where} claims {width} x {height} pixels, but has at most {MOST_PIXELS:,} in a dataset"
        )


def write_exr(layers: Layers, path: Path) -> None:
    """Write an EXR file of a view's layers, parts and channels as in `EXR_PARTS`, without any date.

    Raises
    ------
    OSError
        If there is no room for it; the library has an error of its own for that, which does not blame the place.
    """
    parts = []
    for name, channels in EXR_PARTS.items():
        image = getattr(layers, name)
        image = image[..., None] if image.ndim == 2 else image
        arrays = {
            channel: np.ascontiguousarray(image[..., index].astype(kind))
            for index, (channel, kind) in enumerate(channels.items())
        }
        header = {"name": name, "type": OpenEXR.scanlineimage, "compression": OpenEXR.ZIP_COMPRESSION}
        parts.append(OpenEXR.Part(header, arrays))
    try:
        OpenEXR.File(parts).write(str(path))
    except RuntimeError as error:
        code = next((code for code in _NO_ROOM if os.strerror(code) in str(error)), None)
        if code is None:
            raise
        raise OSError(code, os.strerror(code), str(path)) from error


def _size(window: tuple[np.ndarray, np.ndarray]) -> tuple[int, int]:
    """Width and height of an EXR part, whose first and last pixel are given."""
    first, last = window
    return int(last[0]) - int(first[0]) + 1, int(last[1]) - int(first[1]) + 1


def read_exr(path: str | Path) -> Layers:
    """The layers of a file that `write_exr` made.

    Raises
    ------
    FormatError
        Where it is no EXR file, or a part or channel is missing.
    """
    if not Path(path).is_file():
        raise FormatError(f"there is no file {path}")
    try:
        with OpenEXR.File(str(path), header_only=True) as file:
            sizes = {_size(part.header["dataWindow"]) for part in file.parts}
        for width, height in sizes:
            _check_size(width, height, str(path))
        if len(sizes) != 1:
            raise FormatError(f"{path} has parts of {len(sizes)} sizes, but all must have one")
        with OpenEXR.File(str(path), separate_channels=True) as file:
            channels_of = {
                part.name(): {name: c.pixels for name, c in part.channels.items()} for part in file.parts
            }
    except FormatError:
        raise
    except Exception as error:  # the library raises plain RuntimeErrors and its own types
        raise FormatError(f"{path} is not a readable EXR file: {error}") from error
    images = {}
    for name, channels in EXR_PARTS.items():
        missing = [f"{name}.{channel}" for channel in channels if channel not in channels_of.get(name, {})]
        if missing:
            raise FormatError(
                f"{path} has no {missing[0]}; a view's EXR has the parts {', '.join(EXR_PARTS)}"
            )
        image = np.stack([channels_of[name][channel] for channel in channels], axis=-1)
        images[name] = image[..., 0] if len(channels) == 1 else image
    return Layers(
        radiance=images["radiance"].astype(np.float32),
        depth=images["depth"],
        normal=images["normal"].astype(np.float32),
        part=images["part"].astype(np.uint8),
        uv=images["uv"],
    )
