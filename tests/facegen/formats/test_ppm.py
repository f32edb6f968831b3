"""Pictures through pipes."""

import io

import numpy as np
import pytest

from facegen.errors import FormatError
from facegen.formats.ppm import ppm_bytes, read_ppm_stream


def test_pictures_come_out_of_a_stream_as_they_went_in():
    rng = np.random.default_rng(0)
    pictures = [rng.integers(0, 256, (height, 5, 3), dtype=np.uint8) for height in (3, 4)]
    stream = io.BytesIO(b"".join(map(ppm_bytes, pictures)))
    for found, made in zip(read_ppm_stream(stream), pictures, strict=True):
        np.testing.assert_array_equal(found, made)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"no pictures\n", "something else"),
        (b"P6\n2 2\n65535\n" + bytes(24), "something else"),
        (ppm_bytes(np.zeros((2, 2, 3), np.uint8))[:-1], "ends within a picture of 2 x 2"),
    ],
)
def test_what_is_no_stream_of_pictures_is_refused(content: bytes, words: str):
    with pytest.raises(FormatError, match=words):
        list(read_ppm_stream(io.BytesIO(content)))
