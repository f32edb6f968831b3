"""Model folders: equal bytes, honest errors, and predictions as arrays."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import regress
from facegen.conventions import BLENDSHAPE_INDEX, MIRRORED_BLENDSHAPES
from regress.errors import InputError, ModelError, OutputError
from regress.learning.training import KeypointDataset
from regress.runtime.features import extract
from regress.runtime.model import Model, load_model, save_model


def test_saving_and_loading_gives_the_same_model_and_the_same_bytes(quick_model: Model, tmp_path: Path):
    save_model(quick_model, tmp_path / "one")
    loaded = load_model(tmp_path / "one")
    save_model(loaded, tmp_path / "deep" / "two")
    for name in ("model.json", "weights.npz"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "deep" / "two" / name).read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["deep", "one"]
    assert loaded.record == quick_model.record
    assert loaded.table == quick_model.table


def test_a_model_replaces_a_model_and_nothing_else(quick_model: Model, tmp_path: Path):
    save_model(quick_model, tmp_path / "model")
    save_model(quick_model, tmp_path / "model")
    assert [path.name for path in tmp_path.iterdir()] == ["model"]
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes" / "a.txt").write_text("mine")
    with pytest.raises(OutputError, match="not a model folder"):
        save_model(quick_model, tmp_path / "notes")
    assert (tmp_path / "notes" / "a.txt").read_text() == "mine"
    (tmp_path / "file").write_text("mine")
    with pytest.raises(OutputError):
        save_model(quick_model, tmp_path / "file" / "model")


def test_a_damaged_model_says_which_file(quick_model_folder: Path, tmp_path: Path):
    def broken(change) -> Path:
        folder = tmp_path / str(len(list(tmp_path.iterdir())))
        shutil.copytree(quick_model_folder, folder)
        change(folder)
        return folder

    def edit(**changes):
        def change(folder: Path) -> None:
            document = json.loads((folder / "model.json").read_text()) | changes
            (folder / "model.json").write_text(json.dumps(document))

        return change

    record = json.loads((quick_model_folder / "model.json").read_text())["record"]
    without_mae = json.loads(json.dumps(record))
    del without_mae["scores"]["jawOpen"]["ridge"]["mae"]
    cases = {
        "model.json does not exist": lambda folder: (folder / "model.json").unlink(),
        "weights.npz does not exist": lambda folder: (folder / "weights.npz").unlink(),
        "is not a model's description": lambda folder: (folder / "model.json").write_text("{"),
        "weights.npz is damaged": lambda folder: (folder / "weights.npz").write_bytes(b"PK"),
        "has schema 99": edit(schema=99),
        "model.json is not a model's description: key 'features.alignment' is missing": edit(features={}),
        'record.seed = "x": must be a whole number': edit(record={**record, "seed": "x"}),
        "key 'record.scores.jawOpen.ridge.mae' is missing": edit(record=without_mae),
    }
    for said, change in cases.items():
        with pytest.raises(ModelError, match=said):
            load_model(broken(change))
    with pytest.raises(ModelError, match="a model is a folder"):
        load_model(tmp_path / "nowhere")


def test_predicting_is_a_plain_loop_over_networks(quick_model: Model, dataset: KeypointDataset):
    points = dataset.points[:7]
    predicted = quick_model.predict(points)
    features = extract(quick_model.features, points)
    networks, hidden = quick_model.networks, quick_model.networks.hidden
    row = 0
    for number, network in enumerate(quick_model.table):
        units = slice(number * hidden, (number + 1) * hidden)
        activity = np.tanh(features @ networks.w1[units].T + networks.b1[units])
        for name in network.outputs:
            expected = np.clip(activity @ networks.w2[row] + networks.b2[row], 0, 1)
            assert np.allclose(predicted[:, BLENDSHAPE_INDEX[name]], expected)
            row += 1
    assert (predicted[:, BLENDSHAPE_INDEX["tongueOut"]] == 0).all()
    assert predicted.min() >= 0
    assert predicted.max() <= 1


def test_a_face_with_a_missing_point_is_a_row_of_nan_and_leaves_the_others_alone(
    quick_model: Model, dataset: KeypointDataset
):
    points = dataset.points[:4].copy()
    points[1, 60, 0] = np.nan
    points[2] = np.inf
    predicted = quick_model.predict(points)
    assert np.isnan(predicted[1:3]).all()
    assert np.allclose(predicted[[0, 3]], quick_model.predict(dataset.points[[0, 3]]))
    assert quick_model.predict(np.empty((0, 68, 2))).shape == (0, 52)


def test_points_of_another_shape_are_refused(quick_model: Model):
    with pytest.raises(InputError, match=r"\(n, 68, 2\) is needed"):
        quick_model.predict(np.zeros((68, 2)))


def test_python_users_load_and_predict(
    quick_model_folder: Path, quick_model: Model, dataset: KeypointDataset
):
    loaded = regress.load_model(quick_model_folder)
    assert np.array_equal(loaded.predict(dataset.points), quick_model.predict(dataset.points))


def test_nothing_of_training_is_imported_to_predict():
    heavy = ("sklearn", "pyarrow", "scipy.spatial")
    program = f"import sys, regress; sys.exit(any(name in sys.modules for name in {heavy}))"
    assert subprocess.run([sys.executable, "-c", program], cwd=Path(__file__).parents[2]).returncode == 0


def test_mirroring_twice_is_nothing():
    assert np.array_equal(
        np.arange(52)[list(MIRRORED_BLENDSHAPES)][list(MIRRORED_BLENDSHAPES)], np.arange(52)
    )
