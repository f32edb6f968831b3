"""Films by OpenCV; what they hold is tested where faces are drawn."""

from pathlib import Path

import numpy as np
import pytest

from facegen.formats.film import encode_film


def test_a_film_that_cannot_be_written_says_so(tmp_path: Path):
    frames = np.zeros((2, 32, 32, 3), dtype=np.uint8)
    with pytest.raises(OSError, match=r"films that end in \.nothing"):
        encode_film(tmp_path / "face.nothing", frames, fps=25)


def test_a_frame_that_fails_ends_the_film(tmp_path: Path):
    def frames():
        yield np.zeros((32, 32, 3), dtype=np.uint8)
        raise ValueError("no more faces")

    with pytest.raises(ValueError, match="no more faces"):
        encode_film(tmp_path / "face.mp4", frames(), fps=25)
