"""Readers of landmark files, on real files and on broken ones."""

from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import LANDMARK_COUNT
from facegen.errors import FormatError
from facegen.formats import write_pts
from regress.errors import InputError
from regress.inputs import READERS, Frames, read_frames
from tests.regress.drawn import drawn_faces

FACES = drawn_faces(np.random.default_rng(1), 3)
COLUMNS = [f"{axis}_{index}" for axis in "xy" for index in range(LANDMARK_COUNT)]


def _cells(face: np.ndarray) -> list[str]:
    return [repr(float(value)) for value in face.T.ravel()]


def _openface(path: Path, *, success: tuple[int, ...] = (1, 1, 1)) -> Path:
    lines = [", ".join(["frame", "timestamp", "confidence", "success", *COLUMNS])]
    for row, (face, seen) in enumerate(zip(FACES, success, strict=True)):
        lines.append(", ".join([str(row + 1), str(row / 30), "0.9", str(seen), *_cells(face)]))
    path.write_text("\n".join(lines) + "\n")
    return path


def _pyfeat(path: Path, *, empty: tuple[int, ...] = ()) -> Path:
    lines = [",".join(["FaceScore", *COLUMNS, "frame"])]
    for row, face in enumerate(FACES):
        cells = [""] * len(COLUMNS) if row in empty else _cells(face)
        lines.append(",".join(["0.99", *cells, str(2 * row)]))
    path.write_text("\n".join(lines) + "\n")
    return path


def _example(name: str, folder: Path) -> Path:
    """A file of three faces (one for ``pts``) in a format of the table."""
    if name == "pts_folder":
        (folder / "faces").mkdir()
        for number, face in zip((2, 10, 100), FACES, strict=True):
            write_pts(folder / "faces" / f"frame_{number}.pts", face)
        return folder / "faces"
    if name == "pts":
        write_pts(folder / "one.pts", FACES[0])
        return folder / "one.pts"
    if name == "npy":
        np.save(folder / "a.npy", FACES.astype(np.float32))
        return folder / "a.npy"
    if name == "csv":
        return _openface(folder / "a.csv")
    raise AssertionError(f"the format {name!r} has no example here: write one")


@pytest.mark.parametrize("name", READERS)
def test_every_format_of_the_table_gives_the_points_back(name: str, tmp_path: Path):
    frames = read_frames(_example(name, tmp_path))
    expected = FACES[: len(frames.points)]
    assert len(frames.labels) == len(frames.points) > 0
    assert np.allclose(frames.points, expected, atol=1e-4)
    assert frames.points.dtype == np.float64
    assert frames.usable.all()


def test_a_folder_goes_by_number_not_by_letter(tmp_path: Path):
    assert read_frames(_example("pts_folder", tmp_path)).labels == ("frame_2", "frame_10", "frame_100")


def test_openface_frames_without_success_have_no_face(tmp_path: Path):
    frames = read_frames(_openface(tmp_path / "a.csv", success=(1, 0, 1)))
    assert frames.usable.tolist() == [True, False, True]
    assert frames.labels == ("1", "2", "3")
    assert frames.time_s == pytest.approx([0, 1 / 30, 2 / 30])


def test_pyfeat_rows_with_empty_cells_have_no_face(tmp_path: Path):
    frames = read_frames(_pyfeat(tmp_path / "a.csv", empty=(0,)))
    assert frames.usable.tolist() == [False, True, True]
    assert frames.labels == ("0", "2", "4")


def _subjects_right_is_at_the_images_left(frames: Frames) -> None:
    """Point 0 is the subject's right jaw, 36 the right eye's outer, 48 the right mouth corner; y is down."""
    x, y = frames.points[frames.usable][..., 0], frames.points[frames.usable][..., 1]
    for right, left in ((0, 16), (17, 26), (36, 45), (48, 54)):
        assert (x[:, right] < x[:, left]).all()
    assert (y[:, 8] > y[:, 27]).all()


@pytest.mark.parametrize(
    ("name", "rows", "timed"),
    [
        ("einstein.pts", 1, False),
        ("breakingbad.pts", 1, False),
        ("openface_sequence.csv", 100, True),
        ("pyfeat_clip_001.csv", 20, False),
        ("pyfeat_clip_007.csv", 14, False),
    ],
)
def test_real_files(real: Path, name: str, rows: int, timed: bool):
    frames = read_frames(real / "landmarks" / name)
    assert frames.points.shape == (rows, 68, 2)
    assert (frames.time_s is not None) == timed
    assert len(set(frames.labels)) == rows
    _subjects_right_is_at_the_images_left(frames)


def test_a_real_pts_file_counts_from_1(real: Path):
    path = real / "landmarks" / "einstein.pts"
    first = [float(value) for value in path.read_text().split("{")[1].split()[:2]]
    assert read_frames(path).points[0, 0] == pytest.approx(np.array(first) - 1)


def bad_inputs(folder: Path) -> dict[str, tuple[Path, str]]:
    """Files that cannot be used, each with what must be said about it."""
    folder.mkdir(parents=True, exist_ok=True)
    write_pts(folder / "short.pts", FACES[0][:67])
    np.save(folder / "empty.npy", np.full((2, 68, 2), np.nan))
    np.save(folder / "flat.npy", np.zeros((5, 136)))
    np.save(folder / "words.npy", np.full((1, 68, 2), "x"))
    (folder / "no.npy").write_bytes(b"hello")
    (folder / "other.csv").write_text("a,b\n1,2\n")
    (folder / "nothing.csv").write_text("")
    (folder / "header.csv").write_text(",".join(COLUMNS) + "\n")
    (folder / "cut.csv").write_text(",".join(COLUMNS) + "\n1,2,3\n")
    (folder / "words.csv").write_text(",".join(COLUMNS) + "\n" + ",".join(["x"] * len(COLUMNS)) + "\n")
    (folder / "take.mp4").write_bytes(b"")
    (folder / "bare").mkdir(exist_ok=True)
    _openface(folder / "unseen.csv", success=(0, 0, 0))
    said = {
        "short.pts": "holds 67 points",
        "empty.npy": "no usable frame",
        "flat.npy": "shape (5, 136)",
        "words.npy": "numbers are needed",
        "no.npy": "not a readable .npy file",
        "other.csv": "lacks 136 of the columns x_0",
        "nothing.csv": "lacks 136 of the columns",
        "header.csv": "a header and no rows",
        "cut.csv": "row 2 has 3 cells",
        "words.csv": "not a number",
        "take.mp4": "no known format",
        "bare": "holds no .pts file",
        "unseen.csv": "no usable frame",
        "missing.pts": "does not exist",
    }
    return {name: (folder / name, text) for name, text in said.items()}


def test_bad_files_are_refused_in_one_sentence_that_names_them(tmp_path: Path):
    for name, (path, said) in bad_inputs(tmp_path).items():
        with pytest.raises((InputError, FormatError)) as caught:
            read_frames(path)
        assert said in str(caught.value), name
        assert name in str(caught.value)
        assert "\n" not in str(caught.value)
