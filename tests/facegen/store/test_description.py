"""Whatever stands in ``dataset.json``, each command that opens a dataset says it in one sentence, writes nothing."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import FormatError, InputError
from facegen.spec import load_spec
from facegen.store import DatasetFolder, begin, read_description, resolve

TINY = Path(__file__).resolve().parents[3] / "datasets" / "tiny.toml"

DAMAGES = {
    "list": "[]",
    "null": "null",
    "number": "5",
    "text": '"dataset"',
    "empty": "",
    "cut": '{"format": 1',
    "nested": "[" * 100_000,
    "digits": '{"format": ' + "9" * 5000 + "}",
    "latin": b'{"licence": "\xe9"}',
    "utf-16": '{"format": 1}'.encode("utf-16"),
    "other format": '{"format": 2}',
}


@pytest.fixture(scope="module")
def begun(anny, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("begun") / "tiny"
    begin(resolve(load_spec(TINY), folder))
    return folder


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_every_command_refuses_what_is_no_description(begun, tmp_path, damage):
    path = begun / "dataset.json"
    good = path.read_bytes()
    path.write_bytes(damage if isinstance(damage, bytes) else damage.encode())
    try:
        for words in (
            ["generate", str(TINY), "--out", str(begun)],
            ["validate", str(begun)],
            ["preview", str(begun), "--out", str(tmp_path / "sheet.png")],
            ["pack", str(begun), "--out", str(tmp_path / "pack")],
            ["merge", str(begun), "--out", str(tmp_path / "all")],
            ["merge", str(begun), "--out", str(begun)],
            ["develop", str(begun), "--out", str(tmp_path / "new")],
            ["farm", "status", str(begun)],
            ["farm", "submit", str(TINY), "--out", str(begun), "--engine", "slurm", "--dry-run"],
        ):
            refusal = CliRunner().invoke(app, words).exception
            assert isinstance(refusal, FormatError), (words, refusal)
            assert str(path) in str(refusal)
        assert not list(tmp_path.iterdir())
        assert not (begun / "farm").exists()
    finally:
        path.write_bytes(good)


@pytest.mark.parametrize(
    "change",
    [
        {"format": True},
        {"spec_hash": 5},
        {"spec_hash": "x" * 64},
        {"spec_hash": "a" * 100_000},
        {"label_version": "3"},
        {"licence": None},
        {"licence": "x" * 100_000},
        {"versions": []},
        {"versions": {"facegen": 1}},
    ],
    ids=lambda change: next(f"{key} {str(value)[:8]}" for key, value in change.items()),
)
def test_a_value_of_another_kind_is_named(begun, tmp_path, change):
    described = json.loads((begun / "dataset.json").read_text())
    (tmp_path / "dataset.json").write_text(json.dumps(described | change))
    with pytest.raises(FormatError, match=next(iter(change))):
        read_description(DatasetFolder(tmp_path))


@pytest.mark.parametrize(
    "name", ["x" * 300, "a\0b", "\udcff", "x/" * 3000], ids=["long", "nul", "bytes", "deep"]
)
def test_names_that_no_folder_has(anny, tmp_path, name):
    # no argument of a process has a NUL in it
    for command in ("validate", "preview", "develop", "pack") if "\0" not in name else ():
        words = [
            command,
            f"{tmp_path}/{name}",
            *([] if command == "validate" else ["--out", str(tmp_path / "o.png")]),
        ]
        assert isinstance(CliRunner().invoke(app, words).exception, InputError), words
    for key in ("rig", "headset", "recording"):
        table = {"rig": "", "headset": "[render]\n", "recording": "[playback]\nfps = 30\n"}[key]
        kind = "playback" if key == "recording" else "still"
        value = json.dumps(name + (".toml" if key == "headset" else ""), ensure_ascii=True)
        spec = tmp_path / "spec.toml"
        if "\udcff" not in name:
            spec.write_text(f'version = 1\nkind = "{kind}"\nseed = 1\npeople = 1\n{table}{key} = {value}\n')
            words = ["generate", str(spec), "--out", str(tmp_path / "out")]
            assert isinstance(CliRunner().invoke(app, words).exception, InputError), key
            assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("option", ["--columns", "--views"])
def test_a_pack_of_names_that_there_are_not_writes_nothing(recorded, tmp_path, option):
    form = "keypoints" if option == "--columns" else "webdataset"
    words = [
        "pack",
        str(recorded.folder.path),
        "--out",
        str(tmp_path / "pack"),
        "--format",
        form,
        option,
        "nose",
    ]
    assert isinstance(CliRunner().invoke(app, words).exception, InputError)
    assert not (tmp_path / "pack").exists()
