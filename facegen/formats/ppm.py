"""Reads and writes RGB pictures as PPM (P6), one after the other: what programs pass through pipes.

``ffmpeg -f image2pipe -c:v ppm -i -`` takes such a stream. The format: https://netpbm.sourceforge.net/doc/ppm.html
"""

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from facegen.errors import FormatError


def ppm_bytes(picture: np.ndarray) -> bytes:
    """A PPM file of an RGB picture (h, w, 3) uint8."""
    return b"P6\n%d %d\n255\n" % (picture.shape[1], picture.shape[0]) + picture.tobytes()


def read_ppm_stream(stream: BinaryIO) -> Iterator[np.ndarray]:
    """Give the RGB pictures (h, w, 3) uint8 of a stream that `ppm_bytes` made, each as it comes, until its end.

    Raises
    ------
    FormatError
        Where something else comes, or the stream ends within a picture.
    """
    while header := stream.readline():
        size = stream.readline().split()
        if header != b"P6\n" or len(size) != 2 or stream.readline() != b"255\n":
            raise FormatError("the stream holds something else than PPM pictures (P6, 8 bits)")
        width, height = map(int, size)
        content = stream.read(3 * width * height)
        if len(content) != 3 * width * height:
            raise FormatError(f"the stream ends within a picture of {width} x {height} pixels")
        yield np.frombuffer(content, np.uint8).reshape(height, width, 3)
