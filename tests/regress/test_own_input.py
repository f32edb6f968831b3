"""No command writes over what it reads: a recording may have no other copy."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest

from regress.runtime.features import load_reference_shape
from tests.facegen.formats.test_gltf_animation import avatar
from tests.regress.drawn import drawn_faces
from tests.regress.headset.tiny import write_tiny_model


@pytest.fixture
def take(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A recording as a table, which a table of weights could replace; the working folder is its own."""
    monkeypatch.chdir(tmp_path)
    header = ",".join([*(f"x_{number}" for number in range(68)), *(f"y_{number}" for number in range(68))])
    faces = drawn_faces(np.random.default_rng(1), 3)
    rows = faces.transpose(0, 2, 1).reshape(3, -1)
    np.savetxt(tmp_path / "take.csv", rows, delimiter=",", header=header, comments="")
    return tmp_path / "take.csv"


@pytest.mark.parametrize("name", ["take.csv", "./take.csv", "link.csv", "hard.csv"])
@pytest.mark.parametrize("option", ["--out", "--confidence"])
def test_a_recording_is_not_replaced(name: str, option: str, run, quick_model_folder: Path, take: Path):
    os.symlink(take, "link.csv")
    os.link(take, "hard.csv")
    before = take.read_bytes()
    code, out, err = run("predict", quick_model_folder, "take.csv", option, name)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert f"{option} {Path(name)} is also what is read" in err
    assert take.read_bytes() == before
    assert Path("link.csv").is_symlink()


def test_another_table_is_replaced(run, quick_model_folder: Path, take: Path):
    Path("weights.csv").write_text("old")
    code, _, err = run("predict", quick_model_folder, "take.csv", "--out", "weights.csv")
    assert code == 0, err
    assert Path("weights.csv").read_text().startswith("frame")


def test_a_neutral_face_s_file_is_not_replaced(run, quick_model_folder: Path, take: Path):
    Path("rest.csv").write_bytes(take.read_bytes())
    code, _, err = run(
        "predict", quick_model_folder, "take.csv", "--neutral", "rest.csv", "--out", "rest.csv"
    )
    assert code == 2
    assert "--out rest.csv is also what is read" in err
    assert Path("rest.csv").read_bytes() == take.read_bytes()


def test_an_avatar_is_not_replaced(run, quick_model_folder: Path, take: Path):
    avatar(Path("a.glb"))
    before = Path("a.glb").read_bytes()
    code, _, err = run(
        "predict", quick_model_folder, "take.csv", "--fps", 30, "--gltf", "a.glb", "--out", "a.glb"
    )
    assert code == 2
    assert "--out a.glb is also what is read" in err
    assert Path("a.glb").read_bytes() == before


def test_two_tables_need_two_names(run, quick_model_folder: Path, take: Path):
    code, _, err = run("predict", quick_model_folder, "take.csv", "--out", "w.csv", "--confidence", "./w.csv")
    assert code == 2
    assert "--out and --confidence are both w.csv" in err
    assert not Path("w.csv").exists()


@pytest.mark.parametrize(("name", "chosen"), [("model", "json"), ("weights", "npz"), ("model", "all")])
def test_a_model_is_not_replaced_by_its_export(
    name: str, chosen: str, run, quick_model_folder: Path, take: Path
):
    shutil.copytree(quick_model_folder, "mine")
    before = {path.name: path.read_bytes() for path in Path("mine").iterdir()}
    code, out, err = run("export", "mine", "--out", "mine", "--name", name, "--format", chosen)
    assert (code, out) == (2, "")
    assert "is also what is read (mine" in err
    assert {path.name: path.read_bytes() for path in Path("mine").iterdir()} == before


def test_a_neutral_face_is_not_replaced_by_an_export(run, quick_model_folder: Path, take: Path):
    np.save("rest.npy", drawn_faces(np.random.default_rng(1), 1))
    os.link("rest.npy", "face.json")
    code, _, err = run("export", quick_model_folder, "--neutral", "rest.npy", "--format", "json")
    assert code == 2
    assert "export face.json is also what is read" in err
    assert np.load("rest.npy").shape == (1, 68, 2)


def test_points_of_a_face_are_not_replaced_by_its_edges(run, take: Path):
    points = load_reference_shape().points
    Path("points.json").write_text(json.dumps(points.tolist()))
    code, _, err = run("edges", "points.json", "--out", "points.json")
    assert code == 2
    assert "--out points.json is also what is read" in err
    assert json.loads(Path("points.json").read_text()) == points.tolist()


@pytest.mark.parametrize(("option", "name"), [("--video", "left.mp4"), ("--points", "link.csv")])
def test_films_of_cameras_are_not_replaced(option: str, name: str, run, take: Path):
    Path("left.mp4").write_bytes(b"names are judged before anything is read")
    os.link("left.mp4", "link.csv")
    code, _, err = run("headset", "predict", "--left-eye", "left.mp4", "--out", "w.csv", option, name)
    assert code == 2
    assert f"{option} {name} is also what is read (left.mp4)" in err
    assert Path("left.mp4").read_bytes() == b"names are judged before anything is read"
    assert not Path("w.csv").exists()


def test_a_headset_model_is_not_replaced_by_its_export(run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    write_tiny_model(tmp_path / "mine")
    before = {path.name: path.read_bytes() for path in Path("mine").iterdir()}
    code, _, err = run("headset", "export", "mine", "--out", "mine", "--name", "model")
    assert code == 2
    assert "export mine/model.json is also what is read" in err
    assert {path.name: path.read_bytes() for path in Path("mine").iterdir()} == before


@pytest.mark.parametrize(("option", "name"), [("--sheet", "000.png"), ("--sheet", "../left/000.png")])
def test_a_recorded_picture_is_not_replaced_by_a_check_s_sheet(
    option: str, name: str, run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    (tmp_path / "left").mkdir()
    monkeypatch.chdir(tmp_path / "left")
    Path("000.png").write_bytes(b"names are judged before anything is read")
    code, _, err = run("headset", "check", "--left-eye", ".", option, name)
    assert code == 2
    assert f"{option} {name} is also what is read" in err
    assert Path("000.png").read_bytes() == b"names are judged before anything is read"


def test_a_network_is_not_replaced_by_what_is_adapted_from_it(run, tmp_path: Path):
    write_tiny_model(tmp_path / "mine")
    before = (tmp_path / "mine" / "model.json").read_bytes()
    code, _, err = run("headset", "adapt", tmp_path / "mine", "--rest", "0-9", "--out", tmp_path / "mine")
    assert code == 2
    assert "is also what is read" in err
    assert (tmp_path / "mine" / "model.json").read_bytes() == before
    code, _, err = run("headset", "adapt", "none", "--rest", "0-9", "--out", tmp_path / "mine")
    assert code == 2, err
