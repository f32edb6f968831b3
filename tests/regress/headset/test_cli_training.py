"""`regress headset train`, as a person runs it."""

import shutil
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from regress.cli.headset_train import side_notes
from regress.runtime.headset.network.predictor import load_headset_predictor

pytest.importorskip("torch")


def test_training_by_command_keeps_every_setting(run, arrays_folder: Path, tmp_path: Path):
    words = (
        "--architecture holistic --seed 3 --epochs 2 --modulation 0.1 --camera-dropout 0.3 --randomise 0.5"
    )
    settings = ["--set", "input_size=16", "--set", "code=8", "--set", "hidden=8", "--set", "mirror=false"]
    out = tmp_path / "model"
    code, _, said = run(
        "headset", "train", arrays_folder, "--out", out, *words.split(), *settings, "--no-calibration"
    )
    assert code == 0, said
    assert "epochs: 2 of 2" in said
    assert "uncalibrated: " in said
    assert "same seat" not in said
    recipe = load_headset_predictor(out).model.training.recipe
    wanted = {"architecture": "holistic", "seed": 3, "epochs": 2, "modulation": 0.1, "camera_dropout": 0.3}
    wanted |= {"randomise": 0.5, "input_size": 16, "code": 8, "mirror": False, "calibration": False}
    assert {name: recipe[name] for name in wanted} == wanted


def test_training_tells_cameras_whose_names_have_no_side(run, arrays_folder: Path, tmp_path: Path):
    names = {"left_eye": "eye_a", "right_eye": "eye_b"}
    folder = tmp_path / "arrays"
    shutil.copytree(arrays_folder, folder)
    table = pq.read_table(folder / "labels.parquet")
    columns = {f"points_{name}": f"points_{other}" for name, other in names.items()}
    pq.write_table(
        table.rename_columns([columns.get(name, name) for name in table.column_names]),
        folder / "labels.parquet",
    )
    text = (folder / "arrays.json").read_text()
    for name, other in names.items():
        (folder / f"{name}.npy").rename(folder / f"{other}.npy")
        text = text.replace(name, other)
    (folder / "arrays.json").write_text(text)
    settings = [word for one in ("input_size=16", "code=8", "hidden=8") for word in ("--set", one)]
    code, _, said = run("headset", "train", folder, "--out", tmp_path / "model", "--epochs", 1, *settings)
    assert code == 0, said
    assert "eye_a, eye_b: the name says neither left nor right" in said
    assert "call cameras left_eye and right_eye" in said
    cameras = load_headset_predictor(tmp_path / "model").model.cameras
    assert [camera.mirrored_of for camera in cameras] == [None] * 3
    assert side_notes(("left_eye", "right_eye", "mouth")) == []
