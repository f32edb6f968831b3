"""A film that says how to turn it, as telephones write them: pixels as the sensor lies, and a matrix beside them."""

import struct
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from facegen.formats.film import encode_film

_MATRIX = 44
"""Bytes from a track header's name to its matrix, in version 0 (ISO/IEC 14496-12, 8.3.2)."""

_QUARTER_TURN = (0, 1 << 16, 0, -1 << 16, 0, 0, 0, 0, 1 << 30)
"""Clockwise; numbers are 16.16, those of the last column 2.30."""


def lying_film(path: Path, pictures: Iterable[np.ndarray], *, fps: float = 30.0) -> Path:
    """Write upright RGB pictures a quarter turn to the left, with the word to turn them back."""
    encode_film(path, (np.ascontiguousarray(np.rot90(picture)) for picture in pictures), fps=fps)
    content = bytearray(path.read_bytes())
    place = content.index(b"tkhd") + _MATRIX
    content[place : place + 36] = struct.pack(">9i", *_QUARTER_TURN)
    path.write_bytes(content)
    return path
