"""No command writes over what it reads: a recording may have no other copy."""

import os
from pathlib import Path

import numpy as np
import pytest

from tests.facegen.formats.test_gltf_animation import avatar
from tests.regress.drawn import drawn_faces


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
