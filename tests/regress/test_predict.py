"""Tables of weights: smoothing, empty rows, what the CSV holds."""

import csv
import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES
from facegen.formats import write_pts
from regress.cli.neutral_faces import named_rows
from regress.learning.training import KeypointDataset
from regress.runtime.inputs import Frames
from regress.runtime.model import Model
from regress.runtime.predict import predict_frames
from regress.runtime.sample import Sample
from regress.runtime.stages.smoothing import MeanSmoothing, MovingAverage
from regress.runtime.writers.csv_table import weights_csv
from tests.regress.drawn import drawn_faces


def _frames(points: np.ndarray, *, time_s: np.ndarray | None = None) -> Frames:
    return Frames(points=points, labels=tuple(map(str, range(len(points)))), time_s=time_s, source="here")


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 10**6), rows=st.integers(1, 30), window=st.integers(1, 12))
def test_smoothing_is_the_mean_of_the_last_frames(seed: int, rows: int, window: int):
    rng = np.random.default_rng(seed)
    weights = rng.uniform(size=(rows, 3))
    weights[rng.random(rows) < 0.2] = np.nan
    samples = [Sample(weights=row) for row in weights]
    smooth = [sample.weights for sample in MovingAverage(window).run(samples)]
    for row in range(rows):
        if np.isnan(weights[row]).any():
            assert np.isnan(smooth[row]).all()
        else:
            assert smooth[row] == pytest.approx(
                np.nanmean(weights[max(0, row - window + 1) : row + 1], axis=0)
            )


def test_a_pause_without_frames_is_no_part_of_a_mean():
    times = [0.0, 0.1, 60.0, 60.1]
    samples = [Sample(time_s=time, weights=np.full(3, row)) for row, time in enumerate(times)]
    assert [sample.weights[0] for sample in MovingAverage(10).run(samples)] == [0.0, 0.5, 2.0, 2.5]


def test_frames_that_always_come_seldom_are_averaged():
    samples = [Sample(time_s=2.0 * row, weights=np.full(3, row)) for row in range(4)]
    assert [sample.weights[0] for sample in MovingAverage(10).run(samples)] == [0.0, 1.0, 1.5, 2.0]
    assert [sample.weights[0] for sample in MeanSmoothing(3).run(samples)] == [0.0, 1.0, 1.5, 2.0]
    assert [sample.weights[0] for sample in MeanSmoothing(1, ahead=1).run(samples)] == [0.0, 1.5, 2.0, 2.5]


def test_the_csv_reads_back_with_empty_cells_where_no_face_is(quick_model: Model, dataset: KeypointDataset):
    points = dataset.points[:4].copy()
    points[2] = np.nan
    prediction = predict_frames(quick_model, _frames(points, time_s=np.arange(4) / 30))
    assert np.isnan(prediction.weights).all(axis=1).tolist() == [False, False, True, False]
    rows = list(csv.DictReader(io.StringIO(weights_csv(prediction))))
    assert list(rows[0]) == ["frame", "time_s", *BLENDSHAPES]
    assert [row["frame"] for row in rows] == ["0", "1", "2", "3"]
    assert all(rows[2][name] == "" for name in BLENDSHAPES)
    read = np.array([[float(rows[row][name]) for name in BLENDSHAPES] for row in (0, 1, 3)])
    assert np.allclose(read, prediction.weights[[0, 1, 3]], atol=5.1e-7)
    without = weights_csv(predict_frames(quick_model, _frames(points)))
    assert without.startswith("frame,eyeBlinkLeft,")


@pytest.mark.parametrize(
    ("named", "rows"),
    [
        ("1/0", {"0": [0], "1": []}),
        ("1/0-3/0", {"0": [0, 1, 2], "1": []}),
        ("2/1-3/1", {"0": [], "1": [1, 2]}),
        ("2", {"0": [1], "1": [1]}),
        ("1-3", {"0": [0, 1, 2], "1": [0, 1, 2]}),
        ("1/0-3/1", {"0": [], "1": []}),
    ],
)
def test_neutral_frames_of_a_picture_are_everyones_own(named: str, rows: dict[str, list[int]]):
    labels = ("1/0", "1/1", "2/0", "2/1", "3/0", "3/1")
    faces = Frames(
        points=np.zeros((6, 68, 2)),
        labels=labels,
        time_s=None,
        source="here",
        faces=("0", "1") * 3,
        picture_names=("1", "1", "2", "2", "3", "3"),
    )
    assert {face: named_rows(faces.take(kept), named) for face, kept in faces.takes().items()} == rows


@pytest.mark.parametrize(
    ("named", "rows"), [("1-30", [1, 2]), ("10-15", [2]), ("0-9", [0, 1]), ("1-4", []), ("5-x", [])]
)
def test_a_range_of_pictures_may_begin_and_end_with_one_that_was_left_out(named: str, rows: list[int]):
    frames = Frames(
        points=np.zeros((4, 68, 2)),
        labels=("0", "5", "15", "45"),
        time_s=None,
        source="here",
        numbers=np.array([0, 5, 15, 45]),
    )
    assert named_rows(frames, named) == rows
    by_name = replace(frames, labels=("a.png", "b.png", "c.png", "d.png"))
    assert named_rows(by_name, named) == [], "pictures that are called otherwise are not named by their place"


@pytest.mark.parametrize(("named", "rows"), [("take-1", [0]), ("take-1-take-2", [0, 1]), ("4-5", [])])
def test_names_of_frames_may_have_dashes(named: str, rows: list[int]):
    frames = Frames(points=np.zeros((2, 68, 2)), labels=("take-1", "take-2"), time_s=None, source="here")
    assert named_rows(frames, named) == rows


def _beside(faces: np.ndarray, face: int) -> np.ndarray:
    """Faces where the person of this number is, whom the ones beside never reach."""
    return faces - faces.mean(axis=1, keepdims=True) + np.array([10_000.0 * face, 0.0])


def test_each_of_several_faces_is_a_take_of_its_own(run, tmp_path: Path):
    """Two people of one py-feat table get what each of them gets alone: filtered, and by their own neutral faces."""
    rng = np.random.default_rng(5)
    people = [_beside(drawn_faces(rng, 40), face) for face in range(2)]
    both = [(frame, people[face][frame]) for frame in range(40) for face in range(2)]
    alone = []
    for name, rows in [("both", both), *((str(face), list(enumerate(people[face]))) for face in range(2))]:
        header = ["frame", *(f"{axis}_{point}" for point in range(68) for axis in "xy")]
        lines = [",".join(map(repr, [frame, *face.ravel().tolist()])) for frame, face in rows]
        (tmp_path / f"{name}.csv").write_text("\n".join([",".join(header), *lines]) + "\n")
        code, out, said = run("predict", tmp_path / f"{name}.csv", "--fps", 30, "--neutral", "3-5")
        assert code == 0, said
        alone.append([line.split(",")[1:] for line in out.splitlines()[1:]])
    together, *each = alone
    assert [together[0::2], together[1::2]] == each


@pytest.mark.parametrize("several", [False, True])
def test_what_holds_one_face_gets_the_one_that_is_seen_longest(run, tmp_path: Path, several: bool):
    faces = drawn_faces(np.random.default_rng(7), 9)
    header = ["frame", *(f"{axis}_{point}" for point in range(68) for axis in "xy")]
    frames = [*range(8), 3] if several else range(8)
    faces = np.concatenate([_beside(faces[:8], 0), _beside(faces[8:], 1)])
    rows = sorted(zip(frames, faces, strict=False), key=lambda row: row[0])
    lines = [",".join(map(repr, [frame, *face.ravel().tolist()])) for frame, face in rows]
    (tmp_path / "take.csv").write_text("\n".join([",".join(header), *lines]) + "\n")
    code, out, said = run("predict", tmp_path / "take.csv", "--fps", 30, "--format", "livelink")
    assert code == 0, said
    assert len(out.splitlines()) == 1 + 8
    assert ("of one: face 0 is written, with 8 of 9 rows" in said) == several


def test_a_face_that_is_not_at_rest_is_told_of_and_the_other_is_calibrated(run, tmp_path: Path):
    faces = drawn_faces(np.random.default_rng(6), 5)
    faces = np.concatenate(
        [_beside(face[None], person) for face, person in zip(faces, [0, 1, 0, 1, 0], strict=True)]
    )
    header = ["frame", *(f"{axis}_{point}" for point in range(68) for axis in "xy")]
    frames = [1, 1, 2, 2, 3]
    lines = [
        ",".join(map(repr, [frame, *face.ravel().tolist()]))
        for frame, face in zip(frames, faces, strict=True)
    ]
    (tmp_path / "take.csv").write_text("\n".join([",".join(header), *lines]) + "\n")
    code, _, said = run("predict", tmp_path / "take.csv", "--neutral", "3")
    assert code == 0
    assert "weights of face 1 are not calibrated: --neutral names no usable frame of it" in said


def test_a_face_whose_neutral_frames_are_lost_keeps_nobody_else_from_theirs(run, tmp_path: Path):
    faces = drawn_faces(np.random.default_rng(6), 4)
    header = ["frame", *(f"{axis}_{point}" for point in range(68) for axis in "xy")]
    lines = [
        ",".join(map(repr, [frame, *face.ravel().tolist()]))
        for frame, face in zip([1, 1, 2, 2], faces, strict=True)
    ]
    lines[1] = "1" + "," * 136
    (tmp_path / "take.csv").write_text("\n".join([",".join(header), *lines]) + "\n")
    code, out, said = run("predict", tmp_path / "take.csv", "--neutral", "1")
    assert (code, len(out.splitlines())) == (0, 5), said
    assert "weights of face 1 are not calibrated: --neutral names no usable frame of it" in said


@pytest.mark.parametrize("count", [2, 10, 12])
def test_folders_are_called_folders_and_many_are_summed_up(count: int, run, tmp_path: Path):
    for number, face in enumerate(drawn_faces(np.random.default_rng(8), count + 1)):
        folder = tmp_path / "root" / f"{max(number, 1):02d}"
        folder.mkdir(parents=True, exist_ok=True)
        write_pts(folder / f"{number}.pts", face)
    for neutral, one, all_ in (
        ("auto", "no neutral face found of folder 02, ", f"neutral faces found of 0 of {count} folders"),
        (
            "01/0",
            "weights of folder 02 are not calibrated",
            f"weights of {count - 1} of {count} folders are not",
        ),
    ):
        code, _, said = run("predict", "landmarks-default", tmp_path / "root", "--neutral", neutral)
        assert code == 0, said
        assert (one in said, all_ in said) == (count <= 10, count > 10)
    code, _, said = run("predict", tmp_path / "root", "--fps", 30, "--format", "livelink")
    assert f"folder 01 is written, with 2 of {count + 1} rows" in said


def test_a_neutral_frame_without_a_face_is_refused_in_a_sentence(run, tmp_path: Path):
    faces = drawn_faces(np.random.default_rng(1), 3)
    faces[1] = np.nan
    np.save(tmp_path / "take.npy", faces)
    code, out, said = run("predict", tmp_path / "take.npy", "--neutral", 1)
    assert (code, out) == (2, "")
    assert "no neutral frame is usable" in said
