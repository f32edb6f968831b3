"""``.pts`` files: what is read, what is written, what is refused."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from facegen.formats import FormatError, read_pts, write_pts

PIXELS = st.floats(-1e4, 1e4, allow_nan=False)


def test_the_first_pixel_is_1_in_the_file_and_0_here(tmp_path: Path):
    path = tmp_path / "a.pts"
    path.write_text("version: 1\nn_points:  2\n{\n1.0 1.0\n3.5 2\n}\n")
    assert np.array_equal(read_pts(path), [[0, 0], [2.5, 1]])


@given(points=arrays(np.float64, (68, 2), elements=PIXELS))
def test_writing_then_reading_gives_the_points_back(
    tmp_path_factory: pytest.TempPathFactory, points: np.ndarray
):
    path = tmp_path_factory.mktemp("pts") / "a.pts"
    write_pts(path, points)
    assert np.allclose(read_pts(path), points, atol=5.1e-7)  # six decimals


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "not a .pts file"),
        ("hello", "not a .pts file"),
        ("version: 1\nn_points: 2\n{\n1 1\n}", "n_points: 2 and holds 1"),
        ("version: 1\nn_points: 1\n{\n1 1 1\n}", "point 1 is '1 1 1'"),
        ("version: 1\nn_points: 1\n{\n1 x\n}", "not a number"),
        ("version: 1\nn_points: 1\n{\n1 1", "not a .pts file"),
    ],
)
def test_what_is_no_pts_file_is_refused(tmp_path: Path, text: str, said: str):
    path = tmp_path / "bad.pts"
    path.write_text(text)
    with pytest.raises(FormatError, match=said) as caught:
        read_pts(path)
    assert "bad.pts" in str(caught.value)


@pytest.mark.parametrize("mark", ["#", "//"])
def test_comments_are_passed_over(tmp_path: Path, mark: str):
    path = tmp_path / "a.pts"
    path.write_text(
        f"{mark} by {{hand}}\nversion: 1 {mark} of 2\nn_points: 2\n{{\n{mark} eyes\n1 2\n3 4 {mark} left\n}}\n"
    )
    assert read_pts(path).tolist() == [[0, 1], [2, 3]]


def test_binary_is_refused(tmp_path: Path):
    path = tmp_path / "bad.pts"
    path.write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(FormatError, match="not UTF-8 text"):
        read_pts(path)
