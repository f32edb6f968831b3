"""What a new model may take the place of: nothing that somebody would miss."""

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from regress.errors import OutputError
from regress.runtime.model import HEADSET, KEYPOINTS, Model, check_place, load_model, place, save_model
from tests.regress.headset.tiny import write_tiny_model


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_a_model_of_the_other_kind_stays(quick_model: Model, tmp_path: Path):
    headset = write_tiny_model(tmp_path / "headset")
    save_model(quick_model, tmp_path / "keypoints")
    before = contents(tmp_path)
    with pytest.raises(
        OutputError, match=r"headset is a model of headset pictures, .*; choose another --out"
    ):
        save_model(quick_model, headset)
    with pytest.raises(OutputError, match=r"keypoints is a model of 68 points, .*; choose another --out"):
        write_tiny_model(tmp_path / "keypoints")
    assert contents(tmp_path) == before


def test_the_licences_of_the_data_come_along(quick_model: Model, tmp_path: Path):
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "LICENSE.txt").write_text("Whose the heads are.\n")
    save_model(quick_model, tmp_path / "model", data=tmp_path / "data")
    assert (tmp_path / "model" / "LICENSE.txt").read_text() == "Whose the heads are.\n"
    # of the old model, so it goes with that
    save_model(quick_model, tmp_path / "model", data=tmp_path)
    assert not (tmp_path / "model" / "LICENSE.txt").exists()


@pytest.mark.parametrize(
    "text",
    [
        json.dumps({"format": "layers-model", "modelTopology": {}, "weightsManifest": []}),  # TensorFlow.js
        json.dumps({"kind": ["headset"]}),
        "[1, 2]",
        '{"schema": 4, "blendsh',
    ],
)
@pytest.mark.parametrize("write", [save_model, lambda model, folder: write_tiny_model(folder)])
def test_a_model_json_of_somebody_else_stays(write: Callable, quick_model: Model, tmp_path: Path, text: str):
    folder = tmp_path / "project"
    folder.mkdir()
    (folder / "model.json").write_text(text)
    with pytest.raises(OutputError, match=r"model\.json is of no model that regress wrote; choose another"):
        write(quick_model, folder)
    assert contents(tmp_path) == {"project/model.json": text.encode()}


@pytest.mark.parametrize("name", ["notes.txt", "network.onnx", "sub/notes.txt"])
def test_files_beside_a_model_are_not_lost(quick_model: Model, tmp_path: Path, name: str):
    folder = tmp_path / "model"
    save_model(quick_model, folder)
    (folder / name).parent.mkdir(exist_ok=True)
    (folder / name).write_text("mine")
    before = contents(folder)
    with pytest.raises(OutputError, match=f"holds {name.split('/')[0]} beside its model"):
        save_model(quick_model, folder)
    assert contents(folder) == before


def test_what_systems_leave_in_a_folder_is_nobodys(quick_model: Model, tmp_path: Path):
    folder = tmp_path / "model"
    for _ in range(2):  # an empty folder but for it, and a model's
        folder.mkdir(exist_ok=True)
        (folder / ".DS_Store").write_bytes(b"Bud1")
        save_model(quick_model, folder)
    assert load_model(folder).table == quick_model.table


def test_a_report_and_exports_go_with_the_model_they_are_of(quick_model: Model, tmp_path: Path):
    for write in (lambda: save_model(quick_model, tmp_path / "a"), lambda: write_tiny_model(tmp_path / "b")):
        write()
    fresh = contents(tmp_path)
    for folder in (tmp_path / "a", tmp_path / "b"):
        (folder / "report.html").write_text("old")
        (folder / "exports").mkdir()
        (folder / "exports" / "face.onnx").write_text("old")
    save_model(quick_model, tmp_path / "a")
    write_tiny_model(tmp_path / "b")
    assert contents(tmp_path) == fresh


def test_an_empty_folder_will_do(quick_model: Model, tmp_path: Path):
    (tmp_path / "model").mkdir()
    save_model(quick_model, tmp_path / "model")
    assert load_model(tmp_path / "model").table == quick_model.table


@pytest.mark.parametrize("folder", [".", ".."])
@pytest.mark.parametrize("kind", [KEYPOINTS, HEADSET])
def test_a_folder_without_a_name_is_refused_before_training(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, folder: str, kind
):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(OutputError, match="has no name; choose another --out"):
        check_place(folder, kind)


def test_a_rename_that_fails_brings_the_old_model_back(
    quick_model: Model, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    folder = tmp_path / "model"
    save_model(quick_model, folder)
    before = contents(tmp_path)
    rename = Path.rename

    def failing(self: Path, target: os.PathLike[str]) -> Path:
        if self.name == "new":
            raise OSError("the disk is gone")
        return rename(self, target)

    monkeypatch.setattr(place, "swap_folders", lambda first, second: False)  # as where the system cannot
    monkeypatch.setattr(Path, "rename", failing)
    with pytest.raises(OutputError, match="the disk is gone"):
        save_model(quick_model, folder)
    assert contents(tmp_path) == before


def test_two_folders_change_places_in_two_steps_where_the_system_cannot_in_one(
    quick_model: Model, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    write_tiny_model(tmp_path / "model")
    fresh = contents(write_tiny_model(tmp_path / "other", gain=2.0))
    monkeypatch.setattr(place, "swap_folders", lambda first, second: False)
    write_tiny_model(tmp_path / "model", gain=2.0)
    assert contents(tmp_path / "model") == fresh
    assert sorted(path.name for path in tmp_path.iterdir()) == ["model", "other"]


def test_a_link_to_a_model_stays_one_and_modes_stay(tmp_path: Path):
    folder = write_tiny_model(tmp_path / "disk" / "model")
    folder.chmod(0o750)
    (folder / "model.json").chmod(0o600)
    link = tmp_path / "link"
    link.symlink_to(folder)
    write_tiny_model(link, gain=2.0)
    assert link.is_symlink()
    assert [path.name for path in folder.parent.iterdir()] == ["model"]
    assert (folder.stat().st_mode & 0o777, (folder / "model.json").stat().st_mode & 0o777) == (0o750, 0o600)
    assert contents(link) == contents(write_tiny_model(tmp_path / "fresh", gain=2.0))


def test_a_hidden_folder_of_somebody_else_is_not_swept(tmp_path: Path):
    mine = [tmp_path / ".model-backup", tmp_path / ".model-old-host-1-2"]
    for path in mine:
        path.mkdir()
        (path / "notes.txt").write_text("mine")
        os.utime(path, (0, 0))
    write_tiny_model(tmp_path / "model")
    assert all((path / "notes.txt").is_file() for path in mine)
