"""Versions are compared: no dataset has pictures of two versions of Blender, and others are told."""

import importlib.metadata
import json
import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import ExitCode, InputError
from facegen.spec import load_spec
from facegen.store import begin, merge, read_description, resolve
from facegen.work import check_versions, generate, plan_work

SPEC = 'version = 1\nkind = "still"\nseed = 1\npeople = 3\n'
HERE = importlib.metadata.version("bpy")


@pytest.fixture
def begun(anny, tmp_path: Path) -> Path:
    """A dataset of keypoints alone, beside its spec."""
    (tmp_path / "spec.toml").write_text(SPEC)
    begin(resolve(load_spec(tmp_path / "spec.toml"), tmp_path / "out"))
    return tmp_path / "out"


def say_otherwise(folder: Path, **versions: str) -> None:
    """Let ``dataset.json`` name other versions."""
    path = folder / "dataset.json"
    described = json.loads(path.read_text())
    described["versions"] |= versions
    path.write_text(json.dumps(described))


def with_picture(folder: Path, number: int) -> Path:
    """What stands for a rendered sample."""
    render = folder / "renders" / "000" / f"{number:06d}"
    render.mkdir(parents=True)
    (render / "sample.json").write_text("{}")
    return folder


def test_another_blender_renders_nothing_into_a_dataset(begun: Path):
    say_otherwise(begun, bpy="4.5.0rc1")
    before = {path: path.read_bytes() for path in begun.rglob("*") if path.is_file()}
    arguments = ["generate", str(begun.parent / "spec.toml"), "--out", str(begun), "--samples", "0"]
    result = CliRunner().invoke(app, arguments)
    assert isinstance(result.exception, InputError)
    assert f"was begun with Blender 4.5.0rc1, and here is {HERE}" in str(result.exception)
    assert "install bpy==4.5.0rc1" in str(result.exception)
    assert {path: path.read_bytes() for path in begun.rglob("*") if path.is_file()} == before
    dataset = resolve(load_spec(begun.parent / "spec.toml"), begun)
    with pytest.raises(InputError, match="was begun with Blender"):
        generate(dataset, "0", workers=1)
    # keypoints are not of Blender
    assert generate(dataset, workers=1).left == 0
    assert check_versions(dataset, plan_work(dataset, None)) == "", "nothing is made any more"


def test_versions_of_last_bits_are_told(begun: Path):
    spec = str(begun.parent / "spec.toml")
    plain = CliRunner().invoke(app, ["generate", spec, "--out", str(begun), "--samples", ""])
    assert (plain.exit_code, "was begun with" in plain.stderr) == (ExitCode.OK, False)
    say_otherwise(begun, numpy="1.24.0")
    result = CliRunner().invoke(app, ["generate", spec, "--out", str(begun), "--workers", "1"])
    assert result.exit_code == ExitCode.OK
    assert f"was begun with numpy 1.24.0 (here {importlib.metadata.version('numpy')})" in result.stderr


def test_pictures_of_two_blenders_are_not_joined(begun: Path, tmp_path: Path):
    one = with_picture(begun, 0)
    other = shutil.copytree(begun, tmp_path / "other")
    shutil.rmtree(other / "renders")
    say_otherwise(with_picture(other, 1), bpy="4.5.0rc1")
    with pytest.raises(InputError, match=r"other: was made with Blender 4\.5\.0rc1, and .*out with"):
        merge([one, other], tmp_path / "joined")
    assert not (tmp_path / "joined").exists()
    # without pictures it does not matter what Blender was there, and the description is of what has some
    shutil.rmtree(other / "renders")
    merge([other, one], tmp_path / "joined")
    joined = resolve(load_spec(tmp_path / "joined" / "spec.toml"), tmp_path / "joined")
    assert read_description(joined.folder)["versions"]["bpy"] == HERE
    assert joined.folder.rendered() == [0]
    shutil.rmtree(other / "keypoints", ignore_errors=True)
    with pytest.raises(InputError, match="pictures of two versions may differ"):
        merge([one], other)
