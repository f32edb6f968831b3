"""Points as shares of a picture's width and height, 0 to 1, as MediaPipe's programs give them."""

import csv
import io
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.regress.drawn import drawn_faces

SIZE = np.array([1280, 720])
TOLD = "points lie between 0 and 1, as shares of a picture's width and height; --picture WIDTHxHEIGHT makes"


def _faces(seed: int = 4, count: int = 6) -> np.ndarray:
    """Faces in pixels of such a picture, one of them missing."""
    faces = drawn_faces(np.random.default_rng(seed), count)
    faces = faces - faces.mean(axis=1, keepdims=True)
    faces = 80 * faces / np.abs(faces).max() + SIZE / 2
    faces[2] = np.nan
    return faces


def _shares(faces: np.ndarray) -> np.ndarray:
    return (faces + 0.5) / SIZE


def _weights(text: str) -> np.ndarray:
    rows = [list(row.values())[1:] for row in csv.DictReader(io.StringIO(text))]
    return np.array([[float(cell or "nan") for cell in row] for row in rows])


@pytest.fixture
def given(run, tmp_path: Path):
    """What `regress predict` makes of faces (n, 68, 2) with options: numbers, and what it says."""

    def predict(faces: np.ndarray, *options: object) -> tuple[np.ndarray, str]:
        np.save(tmp_path / "take.npy", faces)
        code, out, said = run("predict", tmp_path / "take.npy", *options)
        assert code == 0, said
        return _weights(out), said

    return predict


def test_shares_are_pixels_where_the_picture_is_known(given, tmp_path: Path):
    np.save(tmp_path / "rest.npy", _faces(5)[:2])
    np.save(tmp_path / "rest_shares.npy", _shares(_faces(5)[:2]))
    size = ("--picture", "1280x720")
    pixels, _ = given(_faces(), *size, "--neutral", tmp_path / "rest.npy")
    shares, said = given(_shares(_faces()), *size, "--neutral", tmp_path / "rest_shares.npy")
    np.testing.assert_allclose(shares, pixels, atol=2e-5)
    assert TOLD not in said


def test_shares_of_an_unknown_picture_are_told_and_taken_for_a_squares(given):
    found, said = given(_shares(_faces()), "--neutral", 0)
    assert said.count(TOLD) == 1
    wide, _ = given(_faces(), "--neutral", 0)
    assert np.nanmax(np.abs(found - wide)) > 0.05, "a stretched face is another one"
    square, _ = given(1000 * _shares(_faces()), "--neutral", 0)
    np.testing.assert_allclose(found, square, atol=2e-5)


@pytest.fixture
def piped(run, monkeypatch: pytest.MonkeyPatch):
    """What `regress predict -` makes of faces (n, 68, 2) with options: its exit code, numbers, and what it says."""

    def predict(faces: np.ndarray, *options: object) -> tuple[int, str, str]:
        lines = ["" if np.isnan(face).any() else " ".join(map(repr, face.ravel().tolist())) for face in faces]
        monkeypatch.setattr(sys, "stdin", io.StringIO("\n".join(lines) + "\n"))
        return run("predict", "-", *options)

    return predict


def test_lines_of_shares_are_pixels_where_the_picture_is_known(given, piped):
    code, out, said = piped(_shares(_faces()), "--picture", "1280x720")
    assert code == 0, said
    np.testing.assert_allclose(_weights(out), given(_faces(), "--picture", "1280x720")[0], atol=2e-5)
    assert TOLD not in said
    code, _, said = piped(_shares(_faces()))
    assert (code, said.count(TOLD)) == (0, 1)


def test_pixels_are_left_alone(given):
    assert TOLD not in given(_faces())[1]


def _at_the_edge() -> np.ndarray:
    """Faces in pixels that leave the picture by and by: one keeps one point in, another has one out."""
    faces = _faces(count=8)
    right, left = faces[..., 0].max(axis=1), faces[..., 0].min(axis=1)
    faces[1, :, 0] += SIZE[0] + 5 - right[1]
    faces[3, :, 0] += SIZE[0] - 5 - left[3]
    faces[5, 0] = [-40, 300]
    return faces


def test_all_of_a_take_are_shares_or_none_is(given, piped):
    """A point outside the picture made its frame one of a square, in a pipe, and a whole take's in a file."""
    pixels, _ = given(_at_the_edge(), "--picture", "1280x720")
    found, said = given(_shares(_at_the_edge()), "--picture", "1280x720")
    np.testing.assert_allclose(found, pixels, atol=2e-5)
    assert TOLD not in said
    code, out, said = piped(_shares(_at_the_edge()), "--picture", "1280x720")
    assert code == 0, said
    np.testing.assert_allclose(_weights(out), pixels, atol=2e-5)


def test_zeros_of_lost_faces_do_not_make_shares_of_pixels(given, piped):
    faces = _faces(count=8)
    faces[[0, 3, 4, 6, 7]] = 0
    known, _ = given(faces[[1, 5]])
    found, said = given(faces)
    np.testing.assert_allclose(found[[1, 5]], known, atol=2e-5)
    assert TOLD not in said
    code, out, said = piped(faces)
    assert code == 0, said
    np.testing.assert_allclose(_weights(out)[[1, 5]], known, atol=2e-5)
    assert TOLD not in said


def test_other_units_are_refused_where_a_picture_is_named(given, piped, run, tmp_path: Path):
    """From -1 to 1, as some programs write them: nothing says how high such a picture is."""
    other = 2 * _shares(_faces()) - 1
    other[..., 0] -= 3
    np.save(tmp_path / "other.npy", other)
    for code, _, said in (
        run("predict", tmp_path / "other.npy", "--picture", "1280x720"),
        piped(other, "--picture", "1280x720"),
    ):
        assert code == 2
        assert "points are neither pixels nor shares of the picture" in said
    given(other)


@pytest.mark.parametrize("width", [1.0, 0.15])
def test_points_about_a_middle_at_zero_are_no_shares(width: float, given, piped):
    """Face widths or metres; a file and a pipe stretched them to the picture's shape."""
    faces = _faces()
    about = faces - faces.mean(axis=1, keepdims=True)
    about *= width / np.ptp(about[0, :, 0])
    known, _ = given(1000 * about, "--neutral", 0)
    found, said = given(about, "--neutral", 0)
    np.testing.assert_allclose(found, known, atol=2e-5)
    assert TOLD not in said
    code, _, said = piped(about, "--picture", "1280x720")
    assert code == 2
    assert "points are neither pixels nor shares of the picture" in said


def test_faces_in_a_picture_s_corner_are_shares(given):
    corner = _faces() - _faces()[:2].reshape(-1, 2).min(axis=0) - 10
    found, said = given(_shares(corner), "--picture", "1280x720")
    np.testing.assert_allclose(found, given(corner, "--picture", "1280x720")[0], atol=2e-5)
    assert TOLD not in said
