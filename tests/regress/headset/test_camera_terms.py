"""Networks of drawn headsets: they may be told where cameras are, and answer as well where they are not."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")
onnx = pytest.importorskip("onnx")

from facegen.conventions import CAMERA_TERMS, CAMERA_TERMS_MIRRORED  # noqa: E402
from regress.errors import InputError, ModelError  # noqa: E402
from regress.exporters.headset_interface import interface_of  # noqa: E402
from regress.learning.headset.arrays import HeadsetArrays, read_arrays  # noqa: E402
from regress.learning.headset.evaluation import Condition, estimate, evaluate  # noqa: E402
from regress.learning.headset.recipe import DRAWN_SETTINGS, HeadsetRecipe  # noqa: E402
from regress.learning.headset.training import train_headset  # noqa: E402
from regress.learning.headset.training.batches import TrainingFrames  # noqa: E402
from regress.learning.headset.training.loop import answer_to, start_training  # noqa: E402
from regress.runtime.headset import HeadsetGraph  # noqa: E402
from regress.runtime.headset.network.outputs import MIRROR, MIRROR_SIGN  # noqa: E402
from regress.runtime.headset.network.predictor import load_headset_predictor  # noqa: E402
from tests.regress.headset.drawn import CAMERAS, write_drawn_arrays  # noqa: E402

QUICK = HeadsetRecipe(input_size=16, code=24, hidden=32, epochs=2, batch=32, camera_terms=True)


@pytest.fixture(scope="module")
def told_arrays(tmp_path_factory: pytest.TempPathFactory) -> HeadsetArrays:
    return read_arrays(write_drawn_arrays(tmp_path_factory.mktemp("told") / "arrays", people=16, told=True))


@pytest.fixture(scope="module")
def folder(told_arrays: HeadsetArrays, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("models") / "any"
    train_headset(told_arrays, QUICK, folder)
    return folder


def test_what_is_told_changes_the_answer_and_may_be_left_out(folder: Path, told_arrays: HeadsetArrays):
    predictor = load_headset_predictor(folder)
    pictures = {name: told_arrays.pictures[name][:5] for name in CAMERAS}
    terms = {name: told_arrays.camera_terms[name][0] for name in CAMERAS}
    plain, told, of_one = (
        one.predict(pictures).weights
        for one in (predictor, predictor.told(terms), predictor.told({"mouth": terms["mouth"]}))
    )
    nothing = predictor.told({}).predict(pictures).weights
    np.testing.assert_array_equal(plain, nothing)
    assert np.abs(plain - told).max() > 1e-4
    assert np.abs(of_one - told).max() > 1e-5
    assert not predictor.typical  # of many headsets there is no typical picture
    assert interface_of(predictor.model, graph="n.onnx")["inputs"]["cameras"]["shape"] == [3, 15]


def test_mirrored_pictures_of_mirrored_cameras_give_the_mirrored_answer(
    folder: Path, told_arrays: HeadsetArrays
):
    predictor = load_headset_predictor(folder)
    eyes = {name: told_arrays.pictures[name][:5] for name in ("left_eye", "right_eye")}
    terms = {name: told_arrays.camera_terms[name][3] for name in eyes}
    swapped = {"left_eye": "right_eye", "right_eye": "left_eye"}
    said = predictor.told(terms).predict(eyes)
    mirrored = predictor.told(
        {name: terms[other] * np.array(CAMERA_TERMS_MIRRORED) for name, other in swapped.items()}
    ).predict({name: eyes[other][:, :, ::-1] for name, other in swapped.items()})
    outputs, others = (
        np.concatenate([one.weights, one.gaze.reshape(-1, 4)], axis=1) for one in (said, mirrored)
    )
    np.testing.assert_allclose(others, outputs[:, MIRROR] * MIRROR_SIGN, atol=1e-5)


def test_frames_are_told_of_their_own_cameras_as_encoders_see_them(told_arrays: HeadsetArrays):
    frames = TrainingFrames(told_arrays, QUICK, told_arrays.rows("train"))
    rows = told_arrays.rows("test")[:4]
    terms = frames.plain_batch(rows).terms
    assert terms.shape == (4, 3, len(CAMERA_TERMS) + 1)
    np.testing.assert_array_equal(terms[..., -1], 1)
    np.testing.assert_allclose(terms[:, 0, :-1], told_arrays.camera_terms["left_eye"][rows])
    right = told_arrays.camera_terms["right_eye"][rows] * np.array(CAMERA_TERMS_MIRRORED, np.float32)
    np.testing.assert_allclose(terms[:, 1, :-1], right)
    drawn = [batch.terms for batch in frames.draw_epoch(np.random.default_rng(0))]
    silent = np.concatenate([(terms == 0).all(axis=(1, 2)) for terms in drawn])
    assert 0.2 < silent.mean() < 0.6
    deaf = TrainingFrames(told_arrays, replace(QUICK, camera_terms=False), told_arrays.rows("train"))
    assert deaf.plain_batch(rows).terms.shape == (4, 3, 0)


def test_each_headsets_rows_are_judged_with_their_own_cameras(folder: Path, told_arrays: HeadsetArrays):
    predictor = load_headset_predictor(folder)
    scores = evaluate(predictor.graph, predictor.model, told_arrays)
    assert {"uncalibrated", "uncalibrated_told", "same_seat_told"} <= scores.conditions.keys()
    rows = told_arrays.rows("test")[[7, 0, 3]]
    together = estimate(predictor.graph, predictor.model, told_arrays, rows, Condition(told=True)).weights
    for row, weights in zip(rows, together, strict=True):
        terms = {name: told_arrays.camera_terms[name][row] for name in CAMERAS}
        pictures = {name: told_arrays.pictures[name][row][None] for name in CAMERAS}
        np.testing.assert_allclose(predictor.told(terms).predict(pictures).weights[0], weights, atol=1e-5)


def test_drawn_headsets_are_trained_for_with_another_recipe(run, told_arrays: HeadsetArrays, tmp_path: Path):
    out = tmp_path / "model"
    sizes = [f"--set={pair}" for pair in ("input_size=16", "code=8", "shift=0.02")]
    code, _, said = run("headset", "train", told_arrays.folder, "--out", out, "--epochs", 1, *sizes)
    assert code == 0, said
    recipe = json.loads((out / "model.json").read_text())["training"]["recipe"]
    for name, value in {**DRAWN_SETTINGS, "shift": 0.02}.items():
        assert recipe[name] == value


@pytest.mark.parametrize("architecture", ["modular", "holistic"])
def test_a_network_has_the_sizes_of_the_one_that_it_begins_as(
    run, told_arrays: HeadsetArrays, tmp_path: Path, architecture: str
):
    sizes = {"input_size": 16, "blocks": 1, "code": 8, "skip": 4, "camera_terms": True}
    first, second = tmp_path / "first", tmp_path / "second"
    said = [f"--set={name}={value}" for name, value in sizes.items()] + ["--architecture", architecture]
    sizes["architecture"] = architecture
    code, _, errors = run("headset", "train", told_arrays.folder, "--out", first, "--epochs", 1, *said)
    assert code == 0, errors
    begun = ["--start", first, "--set", "shift=0.03"]
    code, _, errors = run("headset", "train", told_arrays.folder, "--out", second, "--epochs", 1, *begun)
    assert code == 0, errors
    recipe = json.loads((second / "model.json").read_text())["training"]["recipe"]
    for name, value in {**sizes, "shift": 0.03}.items():
        assert recipe[name] == value
    other = ["--start", first, "--set", "code=12"]
    code, _, errors = run("headset", "train", told_arrays.folder, "--out", second, "--epochs", 1, *other)
    assert code == 2
    assert "start from a model of the same cameras and recipe" in errors


def test_a_network_of_one_headset_is_told_nothing(arrays: HeadsetArrays, tmp_path: Path):
    with pytest.raises(InputError, match=r"does not say where cameras are.* is deleted"):
        train_headset(arrays, QUICK, tmp_path / "model")
    train_headset(arrays, replace(QUICK, camera_terms=False, epochs=1), tmp_path / "model")
    predictor = load_headset_predictor(tmp_path / "model")
    with pytest.raises(InputError, match="trained for one headset"):
        predictor.told({})


def test_a_network_that_is_told_nothing_may_begin_one_that_listens(
    arrays: HeadsetArrays, told_arrays: HeadsetArrays, tmp_path: Path
):
    deaf = replace(QUICK, camera_terms=False, epochs=1)
    train_headset(arrays, deaf, tmp_path / "deaf")
    begun = start_training(told_arrays, QUICK, start=tmp_path / "deaf")
    frames = TrainingFrames(told_arrays, QUICK, told_arrays.rows("train"))
    rows = told_arrays.rows("test")[:6]
    with torch.no_grad():
        said = answer_to(begun.network.eval(), frames.plain_batch(rows)).blended.mean
    scaled = said.numpy() * begun.targets.std + begun.targets.mean
    pictures = {name: told_arrays.pictures[name][rows] for name in CAMERAS}
    graph = load_headset_predictor(tmp_path / "deaf").predict(pictures).weights
    np.testing.assert_allclose(np.clip(scaled[:, :52], 0, 1), graph, atol=1e-3)
    mouth_alone = replace(told_arrays, cameras=told_arrays.cameras[2:])
    with pytest.raises(InputError, match="start from a model of the same cameras"):
        start_training(mouth_alone, QUICK, start=tmp_path / "deaf")


def test_a_graph_and_a_description_that_disagree_are_refused(folder: Path, tmp_path: Path):
    other = tmp_path / "other"
    other.mkdir()
    document = json.loads((folder / "model.json").read_text())
    document["camera_terms"] = []
    (other / "model.json").write_text(json.dumps(document))
    (other / "network.onnx").write_bytes((folder / "network.onnx").read_bytes())
    with pytest.raises(ModelError, match="do not agree"):
        load_headset_predictor(other)
    graph = onnx.load(folder / "network.onnx")
    graph.graph.initializer.append(onnx.numpy_helper.from_array(np.zeros(1, np.float32), "other"))
    graph.graph.input.append(onnx.helper.make_tensor_value_info("other", onnx.TensorProto.FLOAT, [1]))
    with pytest.raises(ModelError, match=r"'other' of .* with a default"):
        HeadsetGraph(graph.SerializeToString(), load_headset_predictor(folder).model.cameras)


def test_predict_reads_where_cameras_are_from_a_headsets_file(run, folder: Path, tmp_path: Path):
    take = tmp_path / "take"
    take.mkdir()
    from tests.regress.headset.takes import write_pictures

    write_pictures(take, np.random.default_rng(0).integers(0, 256, (3, 24, 24), dtype=np.uint8))
    tables = []
    for options in ((), ("--headset", "tracking3")):
        out = tmp_path / f"{len(options)}.csv"
        code, _, said = run("headset", "predict", folder, "--mouth", take, *options, "--out", out)
        assert code == 0, said
        tables.append(out.read_text())
    assert tables[0] != tables[1]
    code, _, said = run("headset", "predict", folder, "--mouth", take, "--headset", "nosuch")
    assert (code, "there is no headset" in said) == (2, True)
