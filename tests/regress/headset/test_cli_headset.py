"""`regress headset evaluate | export` and `regress bench`, as a person runs them."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import onnxruntime
import pytest

from facegen.conventions import BLENDSHAPES
from regress import timing
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.evaluation import evaluate
from regress.runtime.headset.network.estimates import GRAPH_OUTPUTS
from regress.runtime.headset.network.figures import evaluation_to_json
from regress.runtime.headset.network.predictor import load_headset_predictor
from tests.regress.headset.drawn import SIDE
from tests.regress.headset.takes import write_pictures
from tests.regress.headset.tiny import NAMES, write_tiny_model

EXAMPLE = Path(__file__).parents[3] / "docs" / "examples" / "headset_weights.py"


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_tiny_model(tmp_path_factory.mktemp("models") / "tiny", width=SIDE, height=SIDE)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--set", "epoch=2"], "--set 'epoch=2' is not NAME=VALUE with one of batch, "),
        (["--set", "batch=few"], 'batch = "few": must be a whole number'),
        (["--set", "mirror=maybe"], 'mirror = "maybe": must be a boolean'),
        (["--camera-dropout", "2"], "camera_dropout = 2.0: must be less than or equal to 1"),
    ],
)
def test_settings_that_cannot_be_are_one_sentence(
    run, arrays_folder: Path, tmp_path: Path, words: list[str], message
):
    code, _, said = run("headset", "train", arrays_folder, "--out", tmp_path / "model", *words)
    assert (code, message in said, len(said.splitlines())) == (2, True, 1)
    assert not list(tmp_path.iterdir())


def test_without_pytorch_training_names_the_extra_and_the_rest_works(
    run, model: Path, arrays_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    for name in list(sys.modules):
        if name.startswith("regress.learning.headset.training"):
            monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "torch", None)
    code, _, said = run("headset", "train", arrays_folder, "--out", tmp_path / "model")
    assert (code, len(said.splitlines())) == (2, 1)
    assert "pip install 'facegen[headset]'" in said
    assert run("headset", "evaluate", model, arrays_folder)[0] == 0


def test_evaluation_prints_and_gives_all_figures(
    run, model: Path, arrays_folder: Path, arrays: HeadsetArrays
):
    code, out, _ = run("headset", "evaluate", model, arrays_folder, "--json")
    assert code == 0
    predictor = load_headset_predictor(model)
    found = evaluate(predictor.graph, predictor.model, arrays)
    assert json.loads(out) == evaluation_to_json(found)
    assert "frames R2 by shape says little" in found.few
    assert found.few in run("headset", "evaluate", model, arrays_folder)[2]
    code, out, _ = run("headset", "evaluate", model, arrays_folder, "--split", "validation")
    assert code == 0
    lines = {line.partition("  ")[0]: line for line in out.splitlines()}
    for name in (
        "ordinary frames",
        "uncalibrated",
        "same seat",
        "without mouth",
        "floor: resting face",
        *BLENDSHAPES,
    ):
        assert name in lines
    assert "rare combinations" in lines


def test_arrays_of_other_cameras_are_refused(run, arrays_folder: Path, tmp_path: Path):
    other = write_tiny_model(tmp_path / "other")
    code, _, said = run("headset", "evaluate", other, arrays_folder)
    assert code == 2
    assert f"the model needs camera left_eye of 16x12 pixels; {arrays_folder} has left_eye 24x24" in said


def test_an_export_runs_by_what_its_description_says(run, model: Path, tmp_path: Path):
    code, out, _ = run("headset", "export", model, "--out", tmp_path / "exports", "--name", "face")
    assert code == 0
    assert len(out.splitlines()) == 2
    description = json.loads((tmp_path / "exports" / "face.json").read_text())
    session = onnxruntime.InferenceSession(tmp_path / "exports" / description["graph"])
    rng = np.random.default_rng(0)
    feed = {
        name: rng.integers(
            0, 2 if one["type"] == "float32" else 256, [5 if n == "n" else n for n in one["shape"]]
        ).astype(one["type"])
        for name, one in description["inputs"].items()
    }
    assert set(feed) == {value.name for value in session.get_inputs()}
    found = dict(zip(description["outputs"], session.run(list(description["outputs"]), feed), strict=True))
    for name, one in description["outputs"].items():
        assert list(found[name].shape) == [5 if n == "n" else n for n in one["shape"]]
        assert str(found[name].dtype) == one["type"]
    documented = (EXAMPLE.parents[1] / "exports.md").read_text()
    assert [name for name in GRAPH_OUTPUTS if f"| `{name}` |" not in documented] == []
    assert description["shapes"] == list(BLENDSHAPES)
    assert [camera["name"] for camera in description["cameras"]] == list(NAMES)


@pytest.mark.parametrize("calibration", ["optional", "none"])
def test_an_export_tells_programs_whether_neutral_pictures_count(run, tmp_path: Path, calibration: str):
    written = write_tiny_model(tmp_path / "tiny", calibration=calibration)
    assert run("headset", "export", written, "--out", tmp_path)[0] == 0
    description = json.loads((tmp_path / "headset.json").read_text())
    said = [description["inputs"][name]["meaning"] for name in ("neutral_mouth", "calibrated")]
    said.append(description["outputs"]["same_seat"]["meaning"])
    assert ["without neutral pictures" in one for one in said] == [calibration == "none"] * 3


def test_bench_times_a_headset_model(run, model: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(timing, "HEADSET_BATCH_FRAMES", 8)
    code, out, _ = run("bench", model, "--json")
    assert code == 0
    timings = {entry["name"]: entry["microseconds"] for entry in json.loads(out)}
    assert list(timings) == ["ONNX, one frame", "ONNX, calibrated", "ONNX, 8 frames"]
    assert all(0 < taken < 1e6 for taken in timings.values())


@pytest.mark.parametrize("calibrated", [False, True])
def test_the_example_says_what_the_network_says(run, model: Path, tmp_path: Path, calibrated: bool):
    run("headset", "export", model, "--out", tmp_path)
    stacks = {
        name: np.random.default_rng(seed).integers(0, 256, (2, SIDE, SIDE), dtype=np.uint8)
        for seed, name in enumerate(NAMES)
    }
    for name, (frame, neutral) in stacks.items():
        for folder, picture in (("frame", frame), ("neutral", neutral)):
            write_pictures(tmp_path / folder, picture[None], name=f"{name}.png")
    folders = [tmp_path / "frame", *([tmp_path / "neutral"] if calibrated else [])]
    command = [sys.executable, EXAMPLE, tmp_path / "headset.json", *folders]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    said = load_headset_predictor(model).predict(
        {name: one[:1] for name, one in stacks.items()},
        neutral={name: one[1] for name, one in stacks.items()} if calibrated else None,
    )
    (tmp_path / ("neutral" if calibrated else "frame") / "mouth.png").unlink()
    refused = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    assert (refused.returncode, "Traceback" in refused.stderr) == (1, False)
    assert "has no picture mouth.png" in refused.stderr
    printed = dict(line.split()[:2] for line in done.stdout.splitlines()[: len(BLENDSHAPES)])
    assert [float(printed[name]) for name in BLENDSHAPES] == pytest.approx(said.weights[0].tolist(), abs=6e-4)
