"""Sizes that headers claim: those of what encoders wrote, and none less than a decoder then makes."""

import struct

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.formats.picture_size import MOST_PIXELS, picture_size

ENCODINGS = {
    "png": (".png", ()),
    "jpeg": (".jpg", ()),
    "progressive jpeg": (".jpg", (cv2.IMWRITE_JPEG_PROGRESSIVE, 1, cv2.IMWRITE_JPEG_RST_INTERVAL, 2)),
    "bmp": (".bmp", ()),
    "pgm": (".pgm", ()),
    "ascii pgm": (".pgm", (cv2.IMWRITE_PXM_BINARY, 0)),
    "tiff": (".tif", ()),
    "plain tiff": (".tif", (cv2.IMWRITE_TIFF_COMPRESSION, 1)),
    "webp": (".webp", (cv2.IMWRITE_WEBP_QUALITY, 50)),
    "lossless webp": (".webp", (cv2.IMWRITE_WEBP_QUALITY, 101)),
}


def encoded(name: str, width: int, height: int) -> bytes:
    suffix, options = ENCODINGS[name]
    grey = np.random.default_rng(1).integers(0, 256, (height, width), dtype=np.uint8)
    done, content = cv2.imencode(suffix, grey, options)
    assert done
    return content.tobytes()


@pytest.mark.parametrize("name", ENCODINGS)
@given(width=st.integers(1, 700), height=st.integers(1, 50))
def test_the_size_is_the_encoders(name: str, width: int, height: int):
    assert picture_size(encoded(name, width, height)) == (width, height)


@pytest.mark.parametrize("name", ENCODINGS)
@given(places=st.lists(st.tuples(st.integers(0, 150), st.integers(0, 255)), min_size=1, max_size=4))
def test_no_decoder_makes_more_than_the_header_claims(name: str, places: list[tuple[int, int]]):
    content = bytearray(encoded(name, 20, 14))
    for place, value in places:
        content[place % len(content)] = value
    size = picture_size(bytes(content))
    if size is None or size[0] * size[1] > 10**6:
        return
    try:
        grey = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_GRAYSCALE | cv2.IMREAD_ANYDEPTH)
    except cv2.error:
        return
    assert grey is None or grey.size <= size[0] * size[1]


@pytest.mark.parametrize("name", ENCODINGS)
def test_a_header_that_is_cut_has_a_size_or_none(name: str):
    content = encoded(name, 20, 14)
    assert {picture_size(content[:length]) for length in range(len(content))} <= {
        None,
        (20, 14),
        (20, 1),
        (2, 14),
    }


def test_what_is_no_picture_has_none():
    assert picture_size(b"") is None
    assert picture_size(b"hello") is None
    assert picture_size(b"II+\0\x08\0\0\0" + b"\xff" * 40) is None


def test_a_claim_is_read_not_decoded():
    header = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sIIBBBBB", 13, b"IHDR", 65535, 65535, 8, 0, 0, 0, 0)
    width, height = picture_size(header)
    assert width * height > MOST_PIXELS
