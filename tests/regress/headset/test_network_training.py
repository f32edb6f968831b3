"""Training of headset networks on drawn arrays: it learns, repeats, goes on after a stop, and says what it did."""

import csv
import errno
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from facegen.conventions import BLENDSHAPE_INDEX, IRIS_POINTS, VIEW_POINTS  # noqa: E402
from regress.errors import InputError, Interrupted, OutputError  # noqa: E402
from regress.learning.headset.accuracy import share_better, summary  # noqa: E402
from regress.learning.headset.architectures import ARCHITECTURES  # noqa: E402
from regress.learning.headset.arrays import HeadsetArrays  # noqa: E402
from regress.learning.headset.evaluation import evaluate  # noqa: E402
from regress.learning.headset.recipe import HeadsetRecipe, recipe_of  # noqa: E402
from regress.learning.headset.training import train_headset  # noqa: E402
from regress.learning.headset.training.batches import TrainingFrames  # noqa: E402
from regress.learning.headset.training.loop import Training, answer_to, start_training  # noqa: E402
from regress.runtime.headset import HeadsetGraph, read_headset_model  # noqa: E402
from regress.runtime.headset.network.estimates import Estimates  # noqa: E402
from regress.runtime.headset.network.model import HeadsetModel  # noqa: E402
from regress.runtime.headset.network.parts import part_of  # noqa: E402
from regress.runtime.headset.pictures.placement import CameraPlacement  # noqa: E402
from regress.runtime.headset.placing.placement_file import Placement, write_placement  # noqa: E402
from tests.regress.headset.takes import write_pictures  # noqa: E402

LITTLE = {"randomise": 0.0, "shift": 0.03, "scale": 0.04, "rotation_deg": 3.0, "plain": 0.0}
pytestmark = pytest.mark.slow

QUICK = HeadsetRecipe(input_size=16, code=48, hidden=64, epochs=20, batch=16, learning_rate=4e-3, **LITTLE)


@pytest.fixture(scope="module", params=ARCHITECTURES)
def trained(
    request: pytest.FixtureRequest, arrays: HeadsetArrays, tmp_path_factory: pytest.TempPathFactory
) -> tuple[HeadsetModel, Path]:
    folder = tmp_path_factory.mktemp("models") / request.param
    return train_headset(arrays, replace(QUICK, architecture=request.param), folder), folder


def test_it_says_where_points_lie_in_each_cameras_own_pictures(
    trained: tuple[HeadsetModel, Path], arrays: HeadsetArrays, run, tmp_path: Path
):
    model, folder = trained
    irises = {side: [f"{side}_iris_{place}" for place in range(IRIS_POINTS)] for side in ("left", "right")}
    assert {name: sorted(points) for name, points in model.points.items()} == {
        "left_eye": sorted(["left_pupil", *irises["left"]]),
        "right_eye": sorted(["right_pupil", *irises["right"]]),
        "mouth": ["landmark_8"],
    }
    rows = arrays.rows("test")
    found = {}
    # QUICK learns at one lighting alone and formulas have no lamps: points are judged at training's own levels
    held = {name: CameraPlacement(low=one.low[1], high=one.high[1]) for name, one in model.looks.items()}
    placement = tmp_path / "placement.toml"
    write_placement(placement, Placement(cameras=held))
    # the third take is recorded with pictures of three times the side, all but its first
    for name, times in (("held", 1), ("once", 1), ("larger", 3)):
        options: list[str | Path] = ["--placement", placement] if name == "held" else []
        for camera, pictures in arrays.pictures.items():
            take = tmp_path / f"{camera}_{name}"
            write_pictures(take, pictures[rows].repeat(times, axis=1).repeat(times, axis=2))
            write_pictures(take, pictures[rows[:1]])
            options += ["--camera", f"{camera}={take}"]
        table = tmp_path / f"points_{name}.csv"
        code, _, said = run(
            "headset", "predict", folder, *options, "--points", table, "--out", tmp_path / "w.csv"
        )
        assert code == 0, said
        with table.open() as file:
            found[name] = list(csv.DictReader(file))
        assert len(found[name]) == len(rows)
    for camera, points in model.points.items():
        for point in points:
            at_trainings, said, larger = (
                np.array([[float(row[f"{camera}.{point}.{axis}"]) for axis in "xy"] for row in table])
                for table in found.values()
            )
            true = arrays.points[camera][rows, VIEW_POINTS.index(point)]
            spread = np.linalg.norm(true - true.mean(axis=0), axis=1).mean()
            assert np.linalg.norm(at_trainings - true, axis=1).mean() < 0.5 * spread, (camera, point)
            # middles of pixels: pixel 0 became pixels 0, 1 and 2
            np.testing.assert_allclose(larger[1:], 3 * said[1:] + 1, atol=0.02)
            np.testing.assert_array_equal(larger[0], said[0])


def test_it_learns_what_unseen_people_do(trained: tuple[HeadsetModel, Path]):
    scores = trained[0].scores
    found, floor = scores.conditions, scores.floors["mean"]
    # seconds of training: a modular network is at .71 and .20 of the floors then, a holistic one at .88 and .27
    share = {"modular": 0.8}.get(trained[0].architecture, 0.95)
    assert found["uncalibrated"].geometry_mm < share * floor.geometry_mm
    assert found["uncalibrated"].gaze_deg < 0.4 * floor.gaze_deg
    assert found["uncalibrated"].r2 > 0.1
    assert floor.r2 < 0.01
    assert set(scores.cameras) == {"left_eye", "right_eye", "mouth"}
    lower = [name for name in part_of("mouth") if name not in (*part_of("left_eye"), "tongueOut")]
    alone = {camera: np.mean([shapes[name] for name in lower]) for camera, shapes in scores.cameras.items()}
    assert alone["mouth"] > alone["left_eye"] + 0.05
    assert set(scores.combined) == set(found)


def test_the_folder_says_all_there_is_to_say(trained: tuple[HeadsetModel, Path], arrays: HeadsetArrays):
    model, folder = trained
    assert sorted(path.name for path in folder.parent.iterdir()) == [folder.name]
    assert sorted(path.name for path in folder.iterdir()) == ["model.json", "network.onnx"]
    assert read_headset_model(folder) == model
    rows = arrays.kept_rows("train")
    assert {name: np.array(rows).shape for name, rows in model.typical.items()} == dict.fromkeys(
        model.camera_names, (24, 24)
    )
    for name, typical in model.typical.items():  # the drawn pictures are as small themselves
        assert np.abs(np.array(typical) - arrays.pictures[name][rows].mean(axis=0)).max() <= 0.5
    assert model.training.recipe["architecture"] == model.architecture == folder.name
    assert len(model.training.history) == QUICK.epochs
    assert model.training.rows == len(arrays.rows("train"))
    assert model.training.data_seed == arrays.description["seed"]
    assert model.scores.unseen
    assert model.training.onnx_difference < 1e-4
    assert [camera.mirrored_of for camera in model.cameras] == [None, "left_eye", None]
    again = evaluate(HeadsetGraph(folder / "network.onnx", model.cameras), model, arrays)
    assert again == model.scores


def test_a_stopped_training_goes_on_to_the_same_model(arrays: HeadsetArrays, tmp_path: Path):
    recipe = replace(QUICK, epochs=3)
    train_headset(arrays, recipe, tmp_path / "whole")

    def stop(stage: str, done: int, total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(Interrupted, match="2 of 3 epochs"):
        train_headset(arrays, recipe, tmp_path / "stopped", progress=stop)
    assert not (tmp_path / "stopped").exists()
    with pytest.raises(InputError, match="other settings"):
        train_headset(arrays, replace(recipe, seed=1), tmp_path / "stopped")
    state = torch.load(tmp_path / ".stopped.checkpoint", weights_only=True)
    assert 0 < state["cpu_s"] < 1000
    torch.save(state | {"cpu_s": 1000.0}, tmp_path / ".stopped.checkpoint")
    epochs = []
    model = train_headset(
        arrays, recipe, tmp_path / "stopped", progress=lambda _, done, total: epochs.append(done)
    )
    assert epochs == [3]
    assert model.training.resumed_after_epochs == 2
    assert 1000 < model.training.cpu_s < 2000
    graphs = [(tmp_path / name / "network.onnx").read_bytes() for name in ("whole", "stopped")]
    assert graphs[0] == graphs[1]


def test_a_file_that_is_no_checkpoint_is_refused(arrays: HeadsetArrays, tmp_path: Path):
    (tmp_path / ".model.checkpoint").write_bytes(b"nonsense")
    with pytest.raises(InputError, match="not a checkpoint"):
        train_headset(arrays, QUICK, tmp_path / "model")


def test_a_state_that_cannot_be_written_is_said(arrays: HeadsetArrays, tmp_path: Path, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("facegen.files.os.replace", full)
    with pytest.raises(OutputError, match=r"model\.checkpoint: no space left; free some"):
        train_headset(arrays, QUICK, tmp_path / "model")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "settings",
    [
        {"calibration": False},
        {"randomise": 1.0, "shift": 0.06, "scale": 0.12, "rotation_deg": 8.0},
        {"randomise": 1.0, "plain": 0.5, "shift": 0.06, "scale": 0.12, "rotation_deg": 8.0},
        {"part_loss": 0.0, "geometry_loss": 0.0, "mirror": False, "gaze_loss": 5.0},
    ],
)
def test_settings_train(arrays: HeadsetArrays, tmp_path: Path, settings: dict):
    model = train_headset(arrays, replace(QUICK, epochs=1, **settings), tmp_path / "model")
    assert np.isfinite(model.training.history[0]["loss"])
    assert ("same_seat" in model.scores.conditions) == settings.get("calibration", True)
    assert model.training.recipe == replace(QUICK, epochs=1, **settings).settings()
    graph = HeadsetGraph(tmp_path / "model" / "network.onnx", model.cameras)
    pictures, neutral = ({n: seen[at] for n, seen in arrays.pictures.items()} for at in ([1, 2], [0, 5]))
    alone, both = graph.run(pictures), graph.run(pictures, neutral=neutral)
    assert np.array_equal(alone.weights, both.weights) is not settings.get("calibration", True)


def begun_and_graphs_weights(arrays: HeadsetArrays, begun: Training, model: HeadsetModel, folder: Path):
    """Weights of test pictures by a training's network and by a model's graph."""
    batch = begun._frames.plain_batch(arrays.rows("test"))
    with torch.no_grad():
        answer = answer_to(begun.network.eval(), batch)
    weights = (answer.blended.mean * begun._std + begun._mean)[:, :52].clamp(0, 1)
    rows = {name: pictures[arrays.rows("test")] for name, pictures in arrays.pictures.items()}
    return weights, HeadsetGraph(folder / "network.onnx", model.cameras).run(rows).weights


def test_a_network_begins_as_the_one_that_it_starts_from(
    trained: tuple[HeadsetModel, Path], arrays: HeadsetArrays, tmp_path: Path
):
    model, folder = trained
    recipe = replace(
        QUICK, architecture=model.architecture, epochs=1, learning_rate=0, matrix_learning_rate=0
    )
    # without a step it is the same network, whatever its normalisation has seen since
    begun = start_training(arrays, recipe, start=folder)
    np.testing.assert_allclose(*begun_and_graphs_weights(arrays, begun, model, folder), atol=2e-4)
    rows = {name: pictures[arrays.rows("test")] for name, pictures in arrays.pictures.items()}
    # its normalisations are those of training data: training does not begin with a leap (from random numbers: .15)
    frozen = HeadsetGraph(folder / "network.onnx", model.cameras)
    further = train_headset(arrays, replace(recipe, learning_rate=1e-5), tmp_path / "further", start=folder)
    assert further.training.began_as == model.network_sha256
    again = HeadsetGraph(tmp_path / "further" / "network.onnx", model.cameras).run(rows).weights
    assert np.abs(again - frozen.run(rows).weights).mean() < 0.04
    other = replace(recipe, code=32)
    with pytest.raises(InputError, match="start from a model of the same cameras and recipe"):
        start_training(arrays, other, start=folder)


def test_a_deeper_network_begins_as_a_shallower_one(
    trained: tuple[HeadsetModel, Path], arrays: HeadsetArrays, tmp_path: Path
):
    model, folder = trained
    recipe = replace(QUICK, architecture=model.architecture, epochs=1)
    begun = start_training(arrays, replace(recipe, blocks=1), start=folder)
    np.testing.assert_allclose(*begun_and_graphs_weights(arrays, begun, model, folder), atol=2e-4)
    # its blocks learn, and the graph of one that has them gives them on
    deep = train_headset(arrays, replace(recipe, blocks=1), tmp_path / "deep", start=folder)
    again = start_training(arrays, replace(recipe, blocks=2), start=tmp_path / "deep")
    given = again.network.state_dict()
    last = [name for name in given if re.search(r"blocks\.\d\.\d\.convolutions\.4\.weight", name)]
    assert len(last) == 2 * 3 * 2  # encoders, scales and blocks
    assert all(bool(given[name].any()) is (".0.convolutions" in name) for name in last)
    np.testing.assert_allclose(*begun_and_graphs_weights(arrays, again, deep, tmp_path / "deep"), atol=2e-4)
    with pytest.raises(InputError, match=r"do not both have the layer encoders\.\w+\.blocks"):
        start_training(arrays, recipe, start=tmp_path / "deep")


def test_a_recipe_says_how_strong_patches_are(arrays: HeadsetArrays):
    losses = []
    for patches in (0.0, 2.0):
        training = start_training(arrays, replace(QUICK, patches=patches, plain=0.0, randomise=1.0))
        frames = TrainingFrames(arrays, training.recipe, arrays.rows("train"))
        batch = next(iter(frames.draw_epoch(np.random.default_rng(0))))
        losses.append(training._draw_loss(batch, np.random.default_rng(1)).item())
    assert losses[0] != losses[1]


def test_a_training_that_diverges_says_so_and_keeps_nothing(arrays: HeadsetArrays, tmp_path: Path):
    recipe = replace(QUICK, learning_rate=1e30, matrix_learning_rate=1e30)
    training = start_training(arrays, recipe, checkpoint=tmp_path / "kept")
    with pytest.raises(
        InputError, match=r"no longer a number in epoch \d+; begin anew with a lower learning_rate"
    ):
        training.run()
    assert not (tmp_path / "kept").exists()


class Oracle:
    """Says the truth, given the right neutral pictures; and so shows what evaluation asks for."""

    def __init__(self, arrays: HeadsetArrays, rows: np.ndarray) -> None:
        self.arrays, self.rows, self.asked = arrays, rows, []

    def run(self, pictures, *, neutral=None, present=None, calibrated=None) -> Estimates:
        self.asked.append((sorted(pictures), None if neutral is None else neutral["mouth"], calibrated))
        rows, cameras = self.rows, len(self.arrays.cameras)
        return Estimates(
            weights=self.arrays.weights[rows],
            deviation=np.full((len(rows), 52), 0.1, np.float32),
            gaze=self.arrays.gaze[rows].reshape(-1, 2, 2),
            shares=np.full((len(rows), cameras, 52), 1 / cameras, np.float32),
            same_seat=np.full(len(rows), 0.2, np.float32),
        )


def test_evaluation_asks_for_what_it_reports(arrays: HeadsetArrays, trained: tuple[HeadsetModel, Path]):
    rows = np.flatnonzero((arrays.split == "test") & ~arrays.neutral)
    oracle = Oracle(arrays, rows)
    scores = evaluate(oracle, trained[0], arrays)
    assert scores.rows == len(rows)
    for figures in scores.conditions.values():
        assert (figures.geometry_mm, figures.r2, figures.mae) == (0, 1, 0)
        assert figures.gaze_deg < 1e-6
    assert scores.components["combined"].mm["uncalibrated"] == 0
    assert "neutral" not in scores.components
    assert scores.seat == {"same_seat": 0.0, "other_seat": 0.0}
    mouths = [neutral for _, neutral, _ in oracle.asked if neutral is not None]
    np.testing.assert_array_equal(mouths[0], arrays.pictures["mouth"][arrays.neutral_rows()[rows]])
    other = arrays.neutral_rows(other_seat=True)[rows]
    assert any(np.array_equal(seen, arrays.pictures["mouth"][other]) for seen in mouths)
    assert any(calibrated is not None and not calibrated.any() for *_, calibrated in oracle.asked)
    assert ["left_eye", "mouth"] in [cameras for cameras, *_ in oracle.asked]


def test_evaluation_refuses_other_cameras_and_empty_splits(arrays, trained: tuple[HeadsetModel, Path]):
    model, folder = trained
    graph = HeadsetGraph(folder / "network.onnx", model.cameras)
    with pytest.raises(InputError, match="no nowhere row"):
        evaluate(graph, model, arrays, split="nowhere")
    with pytest.raises(InputError, match="needs camera left_eye"):
        evaluate(graph, model, replace(arrays, cameras=arrays.cameras[1:]))


def test_the_gaze_of_open_eyes_leaves_closed_ones_out(arrays: HeadsetArrays):
    weights = np.zeros((2, 52))
    weights[0, BLENDSHAPE_INDEX["eyeBlinkLeft"]] = 0.9
    gaze = np.zeros((2, 2, 2))
    wrong = np.array([[[0.5, 0.0], [0.1, 0.0]], [[0.2, 0.0], [0.0, 0.3]]])
    found = summary(arrays.face, weights, wrong, weights, gaze)
    assert found.gaze_deg == pytest.approx(np.rad2deg(1.1 / 4))
    assert found.gaze_open_deg == pytest.approx(np.rad2deg(0.6 / 3))
    weights[:] = 1
    assert summary(arrays.face, weights, wrong, weights, gaze).gaze_open_deg is None


def test_the_share_of_better_frames_counts_ties_half():
    assert share_better(np.array([1.0, 2.0, 3.0, 3.0]), np.array([2.0, 1.0, 3.0, 4.0])) == 0.625


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"architecture": "other"}, "architecture = \"other\": must be 'modular' or 'holistic'"),
        ({"withhold": "all"}, 'withhold = "all": must be'),
        ({"epochs": 0}, "epochs = 0: must be greater than or equal to 1"),
        ({"modulation": 1.5}, "modulation = 1.5: must be less than or equal to 1"),
        ({"other_seat": 0.7, "jitter_neutral": 0.7}, "together"),
        ({"randomise": -1.0}, "randomise = -1.0: must be greater than or equal to 0"),
    ],
)
def test_impossible_settings_are_refused(settings: dict, message: str):
    with pytest.raises(InputError, match=message):
        recipe_of(settings)


def test_nothing_but_training_loads_torch():
    code = (
        "import sys, regress.runtime.headset, regress.learning.headset.evaluation, regress.cli\n"
        "assert 'torch' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
