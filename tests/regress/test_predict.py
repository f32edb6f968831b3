"""Tables of weights: smoothing, empty rows, what the CSV holds."""

import csv
import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES
from regress.learning.training import KeypointDataset
from regress.runtime.inputs import Frames
from regress.runtime.model import Model
from regress.runtime.predict import predict_frames
from regress.runtime.sample import Sample
from regress.runtime.stages.smoothing import MovingAverage
from regress.runtime.writers.csv_table import weights_csv


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
