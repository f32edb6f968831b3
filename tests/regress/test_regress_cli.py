"""The regress command: what it writes, what it says, how it exits."""

import csv
import dataclasses
import io
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.learning.training import RECIPES, KeypointDataset
from regress.runtime.model import Model
from tests.regress.conftest import QUICK
from tests.regress.test_inputs import bad_inputs

ROOT = Path(__file__).parents[2]


@pytest.fixture
def points_file(dataset: KeypointDataset, tmp_path: Path) -> Path:
    points = dataset.points[:5].copy()
    points[3] = np.nan
    np.save(tmp_path / "points.npy", points)
    return tmp_path / "points.npy"


@pytest.mark.parametrize("known", [0, 3])
def test_train_says_whom_of_the_test_people_it_knows(
    known: int, run, dataset_folder: Path, quick_model: Model, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    record = quick_model.record
    people = dataclasses.replace(record.dataset, people_in_training={"validation": 0, "test": known})
    trained = dataclasses.replace(quick_model, record=dataclasses.replace(record, dataset=people))
    monkeypatch.setattr("regress.learning.training.train", lambda *given, **settings: trained)
    code, _, said = run("train", dataset_folder, "--out", tmp_path / "model")
    assert code == 0, said
    told = "of the test split's people 3 are in training too: figures are not of unseen people"
    assert (told in said) == bool(known)


def test_evaluate_displaces_points_as_a_detector_does(run, quick_model_folder: Path, dataset_folder: Path):
    """Offsets that pass as well, which the record's guess leaves out."""

    def visible(*options: str) -> float:
        code, out, said = run("evaluate", quick_model_folder, dataset_folder, "--json", *options)
        assert code == 0, said
        return json.loads(out)["summary"]["mean_r2_visible"]

    exact, displaced = visible(), visible("--detector", "mediapipe")
    assert displaced < exact - 0.05
    assert displaced == visible("--detector", "mediapipe"), "the same displacements for every model"
    assert visible("--detector", "mediapipe", "--calibrated") != displaced
    code, _, said = run("evaluate", quick_model_folder, dataset_folder, "--detector", "dlib")
    assert code == 2
    assert "--detector is 'dlib', but must be one of" in said


def test_train_writes_a_model_that_evaluate_and_predict_read(
    run, dataset_folder: Path, tmp_path: Path, points_file: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setitem(RECIPES, "default", QUICK)
    code, out, err = run("train", dataset_folder, "--out", tmp_path / "model", "--seed", 3)
    assert (code, out) == (0, "")
    assert "network: test R2" in err
    assert "training: 100 of 100 %" in err
    assert "alpha" not in err
    code, out, _ = run("evaluate", tmp_path / "model", dataset_folder, "--json")
    figures = json.loads(out)
    assert code == 0
    assert len(figures["scores"]) == 51
    code, out, _ = run("evaluate", tmp_path / "model", dataset_folder)
    assert code == 0
    assert "jawOpen" in out
    code, out, _ = run("predict", tmp_path / "model", points_file)
    assert code == 0
    assert len(out.splitlines()) == 6


def test_predict_writes_a_whole_csv_and_names_the_empty_rows(
    run, quick_model_folder: Path, points_file: Path, tmp_path: Path
):
    target = tmp_path / "my weights.csv"
    code, out, err = run("predict", quick_model_folder, points_file, "--out", target, "--smooth", 2)
    assert (code, out) == (0, "")
    assert "1 of 5 rows have no face: 4" in err
    assert f"{target}: 5 frames of 52 weights; facegen preview --weights '{target}' --out" in err
    for nowhere in ((), ("--out", "-")):
        code, out, _ = run("predict", quick_model_folder / "model.json", points_file, *nowhere, "--smooth", 2)
        assert (code, out) == (0, target.read_text())
    rows = list(csv.DictReader(io.StringIO(target.read_text())))
    assert list(rows[0]) == ["frame", *BLENDSHAPES]
    assert rows[3]["jawOpen"] == ""
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []


def test_times_that_no_camera_has_are_told(run, quick_model_folder: Path, points_file: Path, tmp_path: Path):
    table = tmp_path / "thousandth.csv"
    points = np.load(points_file)[[0, 1, 2, 4]].reshape(4, 2, 68, order="A")
    names = [f"{axis}_{index}" for axis in "xy" for index in range(68)]
    lines = [",".join(["frame", "timestamp", "confidence", "success", *names])]
    for row, face in enumerate(points.reshape(4, -1)):
        lines.append(",".join(map(str, [row + 1, row / 1000, 0.9, 1, *face])))
    table.write_text("\n".join(lines) + "\n")
    said = "its times are of 1000 frames a second; --fps"
    assert said in run("predict", quick_model_folder, table)[2]
    assert said not in run("predict", quick_model_folder, table, "--fps", 30)[2]


def test_a_neutral_frame_that_is_not_there_is_answered_with_those_that_are(
    run, quick_model_folder: Path, points_file: Path
):
    code, out, err = run("predict", quick_model_folder, points_file, "--neutral", "nobody")
    assert (code, out) == (2, "")
    assert "neither a frame of" in err
    assert "(0 to 4), nor a file" in err


def test_strict_fails_where_a_frame_has_no_face(
    run, quick_model_folder: Path, points_file: Path, tmp_path: Path
):
    target = tmp_path / "weights.csv"
    code, _, err = run("predict", quick_model_folder, points_file, "--out", target, "--strict")
    assert code == 2
    assert "1 of 5 rows have no face: 4" in err
    assert not target.exists()


def test_bad_inputs_exit_with_2_and_one_sentence(run, quick_model_folder: Path, tmp_path: Path):
    for name, (path, said) in bad_inputs(tmp_path / "bad").items():
        code, out, err = run("predict", quick_model_folder, path)
        assert (code, out) == (2, ""), name
        assert said in err
        assert err.startswith("regress: ")
        assert len(err.splitlines()) == 1


def test_a_missing_model_or_dataset_exits_with_2(
    run, quick_model_folder: Path, points_file: Path, tmp_path: Path
):
    for arguments in (
        ("predict", tmp_path / "none", points_file),
        ("evaluate", tmp_path / "none", tmp_path),
        ("evaluate", quick_model_folder, tmp_path),
        ("train", tmp_path, "--out", tmp_path / "model"),
        ("edges", points_file, "--out", tmp_path / "edges.json"),
        ("edges", tmp_path / "none.npy", "--out", tmp_path / "edges.json"),
        ("edges", quick_model_folder / "weights.npz", "--out", tmp_path / "edges.json"),
        ("train", tmp_path),
        ("frobnicate",),
    ):
        code, out, err = run(*arguments)
        assert (code, out) == (2, ""), arguments
        assert "Traceback" not in err
    assert not (tmp_path / "model").exists()
    assert not (tmp_path / "edges.json").exists()


def test_a_place_that_cannot_be_written_exits_with_74(
    run, quick_model_folder: Path, points_file: Path, dataset_folder: Path, tmp_path: Path
):
    (tmp_path / "file").write_text("mine")
    for arguments in (
        ("predict", quick_model_folder, points_file, "--out", tmp_path / "file" / "a.csv"),
        ("train", dataset_folder, "--out", tmp_path / "file" / "model"),
    ):
        code, _, err = run(*arguments)
        assert code == 74, arguments
        assert "written" in err.splitlines()[-1]
        assert "Traceback" not in err
    assert (tmp_path / "file").read_text() == "mine"


def test_a_folder_for_a_file_exits_with_74(
    run, quick_model_folder: Path, points_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    shipped = json.loads((ROOT / "regress" / "data" / "reference_shape.json").read_text())
    (tmp_path / "points.json").write_text(json.dumps(shipped["points"]))
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path / "empty")
    for arguments in (
        ("predict", quick_model_folder, points_file, "--out", "."),
        ("predict", quick_model_folder, points_file, "--confidence", "."),
        ("report", quick_model_folder, "--out", "."),
        ("edges", tmp_path / "points.json", "--out", "."),
    ):
        code, _, err = run(*arguments)
        assert code == 74, arguments
        assert err.splitlines()[-1].endswith("is a folder; name the file to write")
    assert not list(Path().iterdir())


def test_a_file_of_numbers_on_standard_input_is_one_sentence(quick_model_folder: Path, points_file: Path):
    program = "from regress.cli import main; main()"
    command = [sys.executable, "-c", program, "predict", str(quick_model_folder), "-"]
    with points_file.open("rb") as file:
        left = subprocess.run(
            command,
            cwd=ROOT,
            stdin=file,
            capture_output=True,
            env={**os.environ, "PYTHONIOENCODING": "utf-8:strict"},
        )
    assert (left.returncode, left.stdout) == (2, b"")
    assert left.stderr.startswith(b"regress: standard input is not text")
    assert len(left.stderr.splitlines()) == 1


def test_edges_keeps_the_old_file_where_a_new_one_finds_no_room(run, monkeypatch, tmp_path: Path):
    shipped = json.loads((ROOT / "regress" / "data" / "reference_shape.json").read_text())
    (tmp_path / "points.json").write_text(json.dumps(shipped["points"]))
    (tmp_path / "shape.json").write_text("old")

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    code, _, err = run("edges", tmp_path / "points.json", "--out", tmp_path / "shape.json")
    assert (code, "no space left" in err) == (74, True)
    assert (tmp_path / "shape.json").read_text() == "old"


def test_edges_makes_the_shipped_reference_shape_again(run, tmp_path: Path):
    shipped = json.loads((ROOT / "regress" / "data" / "reference_shape.json").read_text())
    (tmp_path / "points.json").write_text(json.dumps(shipped["points"]))
    code, _, err = run(
        "edges", tmp_path / "points.json", "--out", tmp_path / "shape.json", "--source", shipped["source"]
    )
    assert code == 0
    assert "178 edges" in err
    assert (tmp_path / "shape.json").read_bytes() == (
        ROOT / "regress" / "data" / "reference_shape.json"
    ).read_bytes()


def test_version_and_help(run):
    code, out, _ = run("--version")
    assert code == 0
    assert out.startswith("regress 1.")
    for command in ("train", "evaluate", "predict", "bench", "edges"):
        code, out, _ = run(command, "--help")
        assert code == 0
        assert "Example" in out


_ENDLESS = """
import dataclasses, signal
from facegen import console
from regress.cli import main
from regress.learning.training import RECIPES
from tests.regress.conftest import QUICK
signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
console.LINE_EVERY_S = 0
RECIPES["default"] = dataclasses.replace(QUICK, steps=10**6, search_steps=10**6, patience=10**6, improvement=0.0)
main()
"""


def test_ctrl_c_stops_training_with_a_sentence(dataset_folder: Path, tmp_path: Path):
    command = [sys.executable, "-c", _ENDLESS, "train", str(dataset_folder), "--out", str(tmp_path / "model")]
    process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stderr.readline().startswith("training: 0 of 100 %")
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (75, "")
    assert err.splitlines()[-1] == "regress: training was stopped; no model was written"
    assert "Traceback" not in err
    assert not list(tmp_path.iterdir())


def test_a_closed_pipe_is_quiet(quick_model_folder: Path, tmp_path: Path):
    faces = np.random.default_rng(0).uniform(size=(3000, 68, 2))
    np.save(tmp_path / "many.npy", faces)
    program = "import sys; sys.argv[0] = 'regress'; from regress.cli import main; main()"
    command = [sys.executable, "-c", program, "predict", str(quick_model_folder), str(tmp_path / "many.npy")]
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    process = subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=buffered
    )
    process.stdout.readline()
    process.stdout.close()
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0
    assert b"Traceback" not in err
    assert b"Error" not in err


def test_a_listener_who_has_gone_stops_no_work(quick_model_folder: Path, points_file: Path):
    program = "from regress.cli import main; main()"
    command = [sys.executable, "-c", program, "predict", str(quick_model_folder), str(points_file)]
    process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    process.stderr.close()
    process.stderr = None
    out, _ = process.communicate(timeout=60)
    assert (process.returncode, len(out.splitlines())) == (0, 6)


def test_a_word_that_an_option_does_not_know_is_told_with_those_it_knows(run, tmp_path):
    code, _, err = run("predict", tmp_path / "take.csv", "--format", "xyz")
    assert code == 2
    assert err.startswith("regress: Invalid value for '--format': 'xyz' is not one of 'csv', 'livelink'; see")
