"""A dataset's folder holds all that says what it is."""

import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import InputError, InvalidData
from facegen.formats import live_link_csv
from facegen.headsets import headset_path
from facegen.spec import load_spec
from facegen.store import begin, open_dataset, opening, resolve

SPEC = 'version = 1\nkind = "still"\nseed = 1\npeople = 3\n[render]\nheadset = "mine.toml"\n'


@pytest.fixture
def folder(tmp_path, anny) -> Path:
    own = headset_path("tracking3").read_text().replace('name = "tracking3"', 'name = "mine"')
    (tmp_path / "mine.toml").write_text(own)
    (tmp_path / "spec.toml").write_text(SPEC)
    return tmp_path


def test_a_headset_beside_the_spec_is_used_and_copied(folder):
    dataset = resolve(load_spec(folder / "spec.toml"), folder / "out")
    begin(dataset)
    (folder / "mine.toml").unlink()
    opened = open_dataset(folder / "out")
    assert opened.headset.name == "mine"
    assert opened.hash == dataset.hash


def test_a_folder_that_somebody_looked_into_is_begun(folder):
    """macOS' Finder and Windows' Explorer leave these there."""
    (folder / "out").mkdir()
    for name in (".DS_Store", "Thumbs.db", "desktop.ini"):
        (folder / "out" / name).write_bytes(b"\0")
    begin(resolve(load_spec(folder / "spec.toml"), folder / "out"))
    assert open_dataset(folder / "out").headset.name == "mine"


def test_where_a_headset_lies_does_not_matter_but_what_it_says_does(folder):
    hash_here = resolve(load_spec(folder / "spec.toml"), folder / "out").hash
    (folder / "elsewhere").mkdir()
    for name in ("mine.toml", "spec.toml"):
        (folder / name).rename(folder / "elsewhere" / name)
    spec = folder / "elsewhere" / "spec.toml"
    assert resolve(load_spec(spec), folder / "out").hash == hash_here
    changed = folder / "elsewhere" / "mine.toml"
    text, replaced = re.subn(r"(?m)^black_level = .*", "black_level = 2", changed.read_text())
    assert replaced == 1
    changed.write_text(text)
    assert resolve(load_spec(spec), folder / "out").hash != hash_here


def test_a_headset_that_is_not_there_is_named(folder):
    (folder / "mine.toml").unlink()
    with pytest.raises(InputError, match=r"render\.headset = 'mine\.toml': there is no file"):
        load_spec(folder / "spec.toml")


def test_pictures_that_get_too_high_are_refused_by_the_key_that_makes_them_so(folder):
    own, replaced = re.subn(r"(?m)^(width|height) = .*", r"\1 = 100", (folder / "mine.toml").read_text())
    assert replaced == 6
    (folder / "mine.toml").write_text(own.replace("height = 100", "height = 400", 1))
    with (folder / "spec.toml").open("a") as file:
        file.write("size_px = 4096\n")
    with pytest.raises(
        InputError, match=r"render\.size_px = 4096: camera '.*' has 100 x 400 px .* 4096 x 16384"
    ):
        resolve(load_spec(folder / "spec.toml"), folder / "out")


def _changed(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def test_what_was_changed_after_a_dataset_was_made_is_named(folder):
    spec = load_spec(folder / "spec.toml")
    made = resolve(spec, folder / "out")
    begin(made)
    _changed(made.folder.spec_toml, "people = 3", "people = 4")
    with pytest.raises(InputError, match=r"its spec\.toml or headset\.toml was changed"):
        open_dataset(folder / "out")
    made.folder.spec_toml.unlink()
    with pytest.raises(InputError, match=r"spec\.toml: is missing; facegen generate SPEC --out"):
        open_dataset(folder / "out")
    begin(made)  # as `facegen generate` does, which both sentences name
    assert open_dataset(folder / "out").spec.people == 3
    _changed(made.folder.headset_toml, "black_level = ", "black_level = 1")
    with pytest.raises(InputError, match=r"headset\.toml was changed"):
        open_dataset(folder / "out")
    shutil.copyfile(folder / "mine.toml", made.folder.headset_toml)
    sha256 = open_dataset(folder / "out").rig.sha256
    _changed(made.folder.dataset_json, made.hash, "0" * 64)
    _changed(made.folder.dataset_json, sha256, "0" * 64)
    # a rig of another processor is no other version, and building it again here would change nothing
    for reading in (open_dataset, lambda out: begin(resolve(spec, out))):
        with pytest.raises(InputError, match=r"rig 'anny' is of the same .*; copy anny\.npz and anny\.json"):
            reading(folder / "out")
    _changed(made.folder.dataset_json, "anny 0.6.2, build", "anny 0.6.1, build")
    with pytest.raises(InputError, match="another version of rig 'anny'"):
        open_dataset(folder / "out")
    _changed(made.folder.dataset_json, '"label_version": ', '"label_version": 9')
    with pytest.raises(InputError, match="labels of version 9"):
        open_dataset(folder / "out")


def test_labels_of_shapes_that_the_rig_lacks_are_none_of_this_version(folder, anny, monkeypatch):
    spec = load_spec(folder / "spec.toml")
    whole = resolve(spec, folder / "out")
    # their rig lacks nothing that labels hold
    assert (
        resolve_with(monkeypatch, spec, folder, replace(anny, missing=("eyeLookInLeft",))).hash == whole.hash
    )
    lacking = resolve_with(monkeypatch, spec, folder, replace(anny, missing=("tongueOut",)))
    begin(lacking)
    assert '"missing": [' in lacking.folder.dataset_json.read_text()
    assert "It lacks shapes: tongueOut." in lacking.folder.card.read_text()
    assert open_dataset(folder / "out").hash == lacking.hash != whole.hash
    described = json.loads(lacking.folder.dataset_json.read_text())
    del described["rig"]["missing"]
    lacking.folder.dataset_json.write_text(json.dumps(described | {"spec_hash": whole.hash}))
    for reading in (open_dataset, lambda out: begin(lacking)):
        with pytest.raises(
            InputError, match=r"weights of shapes that its rig 'anny' lacks \(tongueOut\), which"
        ):
            reading(folder / "out")


def resolve_with(monkeypatch, spec, folder, rig):
    """A dataset of a spec whose rig is this one."""
    monkeypatch.setattr(opening, "load_rig", lambda name: rig)
    return resolve(spec, folder / "out")


def test_a_dataset_is_read_by_the_samples_that_it_was_last_asked_for(folder):
    for samples in ("0-2", "0-1", "0-2,5"):
        (folder / "spec.toml").write_text(f'{SPEC}samples = "{samples}"\n')
        wanted = resolve(load_spec(folder / "spec.toml"), folder / "out")
        begin(wanted)
        assert list(open_dataset(folder / "out").samples_to_render()) == list(wanted.samples_to_render())


@pytest.mark.parametrize(
    ("name", "found"),
    [("nowhere", "does not exist"), ("mine.toml", "is a file"), (".", r"holds no dataset\.json")],
)
def test_what_is_no_dataset_says_what_it_is_and_what_makes_one(folder, name, found):
    with pytest.raises(InputError, match=f"{found}, so it is not a facegen dataset; facegen generate SPEC"):
        open_dataset(folder / name)


@pytest.mark.parametrize("damage", ["flipped", "truncated"])
def test_a_damaged_shard_is_named_by_all_that_read_it(recorded, tmp_path, damage):
    copy = shutil.copytree(recorded.folder.path, tmp_path / "copy")
    shard = copy / "keypoints" / "shard-00000.parquet"
    content = bytearray(shard.read_bytes())
    if damage == "truncated":
        del content[len(content) // 2 :]
    else:
        for place in range(1000, len(content) // 2, 1000):  # in the pages of every column
            content[place] ^= 1
    shard.write_bytes(content)
    readers = [
        ("pack", copy, "--format", name, "--out", tmp_path / name) for name in ("keypoints", "livelink")
    ]
    readers += [
        ("pack", copy, "--format", "keypoints", "--split", "train", "--out", tmp_path / "split"),
        ("preview", copy, "--out", tmp_path / "page.html"),
        ("preview", copy, "--out", tmp_path / "sheet.png"),
        ("preview", copy, "--out", tmp_path / "clip.png", "--clip", "0"),
    ]
    for arguments in readers:
        error = CliRunner().invoke(app, list(map(str, arguments))).exception
        assert isinstance(error, InvalidData), (arguments, error)
        assert str(shard) in str(error)
        assert "run facegen validate --repair" in str(error)
    assert not [
        path
        for path in tmp_path.rglob("*")
        if path.is_file() and copy not in path.parents and path.name != "pack.json"
    ]


def test_what_a_spec_names_is_copied_again_where_it_is_missing(folder):
    recording = live_link_csv(np.zeros((4, 52)), np.arange(4) / 30)
    (folder / "take.csv").write_text(recording)
    played = SPEC.replace("still", "playback") + '[playback]\nrecording = "take.csv"\nfps = 30\n'
    (folder / "spec.toml").write_text(played)
    made = resolve(load_spec(folder / "spec.toml"), folder / "out")
    begin(made)
    whole = {path.name: path.read_bytes() for path in (folder / "out").iterdir() if path.is_file()}
    made.folder.headset_toml.unlink()
    with pytest.raises(InputError, match=r"headset\.toml: is missing; facegen generate SPEC --out"):
        open_dataset(folder / "out")
    made.folder.recording_csv.unlink()
    begin(made)
    assert {path.name: path.read_bytes() for path in (folder / "out").iterdir() if path.is_file()} == whole
    assert open_dataset(folder / "out").hash == made.hash


def test_what_a_stopped_beginning_left_is_no_obstacle_and_what_is_another_stays(folder):
    made = resolve(load_spec(folder / "spec.toml"), folder / "out")
    begin(made)
    texts = {path: path.read_bytes() for path in (made.folder.headset_toml, made.folder.spec_toml)}
    ends = (made.folder.dataset_json, made.folder.card, made.folder.croissant_json, made.folder.licences_txt)
    for path in ends:
        path.unlink()
    for path, text in texts.items():
        path.write_bytes(b"# mine\n" + text)
        with pytest.raises(InputError, match=f"{path.name}: is another {path.name} than this dataset's"):
            begin(made)
        assert path.read_bytes() == b"# mine\n" + text
        path.write_bytes(text)
    begin(made)
    assert open_dataset(folder / "out").hash == made.hash


def test_a_spec_is_not_replaced_by_what_it_resolves_to(folder):
    before = (folder / "spec.toml").read_bytes()
    (folder / "mine.toml").rename(folder / "headset.toml")
    (folder / "spec.toml").write_bytes(before.replace(b"mine.toml", b"headset.toml"))
    mine = {path: path.read_bytes() for path in folder.iterdir()}
    with pytest.raises(InputError, match=r"spec\.toml: is another"):
        begin(resolve(load_spec(folder / "spec.toml"), folder))
    assert {path: path.read_bytes() for path in folder.iterdir()} == mine


def test_a_whole_folder_is_not_written_to(folder, monkeypatch):
    made = resolve(load_spec(folder / "spec.toml"), folder / "out")
    begin(made)
    monkeypatch.setattr("facegen.store.beginning.staging", None)
    begin(made)


def test_rows_are_those_of_the_samples_and_of_no_other_columns(recorded):
    whole = recorded.keypoints()
    numbers = [0, 7, 63]
    (rows,) = recorded.rows(numbers, ["sample", "weights"])
    assert rows.column_names == ["sample", "weights"]
    assert rows["sample"].to_pylist() == numbers
    assert rows["weights"].to_pylist() == whole["weights"].take(numbers).to_pylist()
    assert recorded.keypoints(["clip"]).column_names == ["clip"]
