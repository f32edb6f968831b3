"""Tables of weights: smoothing, empty rows, what the CSV holds."""

import csv
import io
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES
from regress.cli.landmark_take import named_rows
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
        ("1/0", [0]),
        ("1/0-3/0", [0, 2, 4]),
        ("2/1-3/1", [3, 5]),
        ("1/0-3/1", [0, 1, 2, 3, 4, 5]),
        ("2", [2]),
        ("1-3", [0, 2, 4]),
        ("take-1", [6]),
        ("take-1-take-2", [6, 7]),
        ("4-5", []),
    ],
)
def test_neutral_frames_are_named_with_their_face_and_with_dashes(named: str, rows: list[int]):
    labels = ("1/0", "1/1", "2/0", "2/1", "3/0", "3/1", "take-1", "take-2")
    frames = Frames(
        points=np.zeros((8, 68, 2)), labels=labels, time_s=None, source="here", numbers=np.arange(8)
    )
    assert named_rows(frames, named) == rows


def test_a_neutral_frame_without_a_face_is_refused_in_a_sentence(run, tmp_path: Path):
    faces = drawn_faces(np.random.default_rng(1), 3)
    faces[1] = np.nan
    np.save(tmp_path / "take.npy", faces)
    code, out, said = run("predict", tmp_path / "take.npy", "--neutral", 1)
    assert (code, out) == (2, "")
    assert "no neutral frame is usable" in said
