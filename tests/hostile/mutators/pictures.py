"""Damages pictures and graphs whose sizes stand in headers."""

import struct
import zlib
from random import Random

import numpy as np

SIZES = (
    (0, 0),
    (1, 1),
    (65_535, 65_535),
    (2**31 - 1, 1),
    (1, 2**31 - 1),
    (100_000, 100_000),
    (2**32 - 1, 2**32 - 1),
)


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def claim(data: bytes, random: Random) -> bytes:
    """A PNG that claims another size, depth or kind of pixels, checksums right."""
    width, height = struct.unpack(">II", data[16:24])
    depth, colour, *rest = data[24:29]
    if random.random() < 0.7:
        width, height = random.choice((*SIZES, (width, height * 1000), (width + 1, height)))
    else:
        depth, colour = random.choice((1, 2, 4, 8, 16, 99)), random.choice((0, 2, 3, 4, 6, 7))
    header = struct.pack(">II", width, height) + bytes([depth, colour, *rest])
    return data[:8] + _chunk(b"IHDR", header) + data[33:]


def pixels(data: bytes, random: Random) -> bytes:
    """A sound picture of another size or kind."""
    import cv2

    shape = random.choice(
        ((1, 1), (7, 3), (1, 5_000), (3_000, 1), (96, 96, 3), (96, 96, 4), (400, 400), (2_000, 2_000))
    )
    kind = random.choice((np.uint8, np.uint8, np.uint16))
    generator = np.random.default_rng(random.randrange(2**32))
    picture = generator.integers(0, random.choice((1, 2, np.iinfo(kind).max)), shape).astype(kind)
    ending = random.choice((".png", ".png", ".jpg", ".tiff", ".bmp", ".webp", ".pgm"))
    if kind is np.uint16 and ending not in (".png", ".tiff", ".pgm"):
        ending = ".png"
    if ending == ".pgm" and picture.ndim == 3:
        ending = ".png"
    return cv2.imencode(ending, picture)[1].tobytes()


PNG = {"claim": claim, "pixels": pixels}
