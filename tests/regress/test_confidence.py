"""Confidence: what a shape's network can do, and how usual the face is to it."""

import csv
import dataclasses
import io

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.errors import InputError
from regress.runtime.model import load_model
from regress.runtime.stages.adjustment import mirror
from regress.runtime.stages.confidence import ALONE, BESIDE_NEUTRAL, confidence, trust


@pytest.fixture
def faces(dataset) -> np.ndarray:
    return dataset.points[dataset.rows("test")]


@pytest.mark.parametrize("calibrated", [False, True])
def test_it_is_at_most_the_test_score_of_the_networks_in_use(calibrated: bool, quick_model, faces):
    model = quick_model.calibrate(faces[:1]) if calibrated else quick_model
    trust = confidence(model, faces)
    assert trust.min() >= 0
    for shape in model.outputs:
        scores = quick_model.record.scores[shape]["calibrated" if calibrated else "network"]
        assert trust[:, BLENDSHAPE_INDEX[shape]].max() <= max(scores.r2 or 0, 0) + 1e-12
    assert (trust[:, BLENDSHAPE_INDEX["tongueOut"]] == 0).all()
    assert trust.max() > 0.2


def test_it_falls_as_faces_get_stranger_and_is_empty_without_a_face(quick_model, faces):
    rng = np.random.default_rng(0)
    width = np.linalg.norm(faces[:, 16] - faces[:, 0], axis=1)[:, None, None]
    means = [
        confidence(quick_model, faces + size * width * rng.normal(size=faces.shape)).mean()
        for size in (0.0, 0.02, 0.05, 0.2)
    ]
    assert means == sorted(means, reverse=True)
    assert means[-1] == 0 < means[0]
    missing = faces[:3].copy()
    missing[1, 4] = np.nan
    assert np.isnan(confidence(quick_model, missing)).all(axis=1).tolist() == [False, True, False]


@pytest.mark.parametrize(("calibrated", "limits"), [(False, ALONE), (True, BESIDE_NEUTRAL)])
def test_networks_beside_a_neutral_frame_are_strange_to_a_face_earlier(calibrated, limits):
    usual, strange = limits
    distance = np.array([0.0, usual, (usual + strange) / 2, strange, strange + 1.0])
    np.testing.assert_allclose(trust(distance, calibrated=calibrated), [1.0, 1.0, 0.5, 0.0, 0.0])


def test_a_model_without_scores_says_so(quick_model, faces):
    with pytest.raises(InputError, match="no test score of eyeBlinkLeft"):
        confidence(dataclasses.replace(quick_model, record=None), faces)


def test_the_command_writes_a_table_beside_the_weights(run, quick_model_folder, faces, tmp_path):
    faces = faces[:6].copy()
    faces[2] = np.nan
    np.save(tmp_path / "take.npy", faces)
    options = ("--confidence", tmp_path / "trust.csv", "--retarget", "vrm1", "--mirror")
    code, out, err = run("predict", quick_model_folder, tmp_path / "take.npy", *options)
    assert code == 0, err
    rows = list(csv.DictReader(io.StringIO((tmp_path / "trust.csv").read_text())))
    assert tuple(rows[0]) == ("frame", *BLENDSHAPES)
    assert [row["frame"] for row in rows] == [line.split(",")[0] for line in out.splitlines()[1:]]
    assert set(rows[2].values()) == {"2", ""}
    kept = [0, 1, 3, 4, 5]
    written = np.array([[float(rows[row][name]) for name in BLENDSHAPES] for row in kept])
    expected = mirror(confidence(load_model(quick_model_folder), faces[kept]))
    np.testing.assert_allclose(written, expected, atol=1e-6)
