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


def test_lines_of_shares_are_pixels_where_the_picture_is_known(given, run, monkeypatch: pytest.MonkeyPatch):
    def piped(*options: object) -> tuple[np.ndarray, str]:
        lines = [
            "" if np.isnan(face).any() else " ".join(map(repr, face.ravel().tolist())) for face in shares
        ]
        monkeypatch.setattr(sys, "stdin", io.StringIO("\n".join(lines) + "\n"))
        code, out, said = run("predict", "-", *options)
        assert code == 0, said
        return _weights(out), said

    shares = _shares(_faces())
    found, said = piped("--picture", "1280x720")
    np.testing.assert_allclose(found, given(_faces(), "--picture", "1280x720")[0], atol=2e-5)
    assert TOLD not in said
    assert piped()[1].count(TOLD) == 1


def test_pixels_are_left_alone(given):
    assert TOLD not in given(_faces())[1]
