"""What must not change a prediction, and how the mirror image must."""

import dataclasses

import numpy as np
import pytest

from facegen.conventions import MIRRORED_BLENDSHAPES, MIRRORED_LANDMARKS, mirrored_name
from regress.errors import InputError
from regress.learning.training import train
from regress.runtime.model import FastPredictor, load_model, save_model, symmetrised
from regress.targets import Network
from tests.regress.conftest import QUICK
from tests.regress.drawn import drawn_faces

FACES = drawn_faces(np.random.default_rng(21), 40)


def mirror_image(faces: np.ndarray) -> np.ndarray:
    """Faces (n, 68, 2) as a mirror shows them, their points named anew."""
    return faces[:, list(MIRRORED_LANDMARKS)] * [-1, 1]


def mirrored_weights(weights: np.ndarray) -> np.ndarray:
    return weights[:, list(MIRRORED_BLENDSHAPES)]


@pytest.mark.parametrize("calibrated", [False, True])
def test_size_place_and_roll_change_nothing(calibrated: bool, quick_model):
    model = quick_model.calibrate(FACES[:1]) if calibrated else quick_model
    turn = np.deg2rad(15)
    roll = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    expected = model.predict(FACES)
    for moved in (FACES * 2, FACES + np.array([137, -55]), FACES @ roll):
        np.testing.assert_allclose(model.predict(moved), expected, atol=1e-9)


@pytest.mark.parametrize("calibrated", [False, True])
def test_a_symmetric_model_gives_the_mean_with_the_mirror_image(calibrated: bool, quick_model):
    symmetric, straight, image = symmetrised(quick_model), quick_model, quick_model
    if calibrated:
        symmetric, straight = symmetric.calibrate(FACES[:1]), straight.calibrate(FACES[:1])
        image = image.calibrate(mirror_image(FACES[:1]))
    raw = (
        straight.predict_raw(FACES) + image.predict_raw(mirror_image(FACES))[:, _partners(quick_model)]
    ) / 2
    np.testing.assert_allclose(symmetric.predict_raw(FACES), raw, atol=1e-9)
    assert np.abs(raw - straight.predict_raw(FACES)).max() > 0.01


def _partners(model) -> list[int]:
    return [model.outputs.index(mirrored_name(name)) for name in model.outputs]


def test_a_symmetric_model_mirrors_exactly_and_is_a_model_like_any_other(quick_model, tmp_path):
    symmetric = symmetrised(quick_model)
    weights = symmetric.predict(FACES)
    np.testing.assert_allclose(symmetric.predict(mirror_image(FACES)), mirrored_weights(weights), atol=1e-9)
    np.testing.assert_allclose(FastPredictor(symmetric).predict(FACES), weights, atol=1e-5)
    save_model(symmetric, tmp_path / "model")
    np.testing.assert_array_equal(load_model(tmp_path / "model").predict(FACES), weights)
    np.testing.assert_allclose(symmetrised(symmetric).predict(FACES), weights, atol=1e-9)


def test_networks_that_see_points_mirror_exactly(stable_model, tmp_path):
    neutral = FACES[:1]
    weights = stable_model.calibrate(neutral).predict(FACES)
    mirrored = stable_model.calibrate(mirror_image(neutral)).predict(mirror_image(FACES))
    np.testing.assert_allclose(mirrored, mirrored_weights(weights), atol=1e-9)
    save_model(stable_model, tmp_path / "model")
    again = load_model(tmp_path / "model")
    assert again.calibrated.features.of_points
    np.testing.assert_array_equal(again.calibrate(neutral).predict(FACES), weights)


def test_a_neutral_face_reads_nothing_where_answers_are_stretched(stable_model):
    for face in FACES[:5]:
        np.testing.assert_allclose(stable_model.calibrate(face[None]).predict_raw(face[None]), 0, atol=1e-9)


def test_a_recipe_can_train_it(dataset):
    quick = dataclasses.replace(QUICK, steps=1, search_steps=1, calibrated=False)
    straight, symmetric = (
        train(dataset, dataclasses.replace(quick, symmetric=value)) for value in (False, True)
    )
    weights = symmetric.predict(FACES)
    np.testing.assert_array_equal(weights, symmetrised(straight).predict(FACES))
    np.testing.assert_allclose(symmetric.predict(mirror_image(FACES)), mirrored_weights(weights), atol=1e-9)
    assert symmetrised(symmetric) is symmetric
    scored = [model.record.summary["network"].mean_r2 for model in (straight, symmetric)]
    assert scored[0] != scored[1]


def test_a_network_of_one_side_cannot_be_made_symmetric(quick_model):
    table = tuple(
        dataclasses.replace(network, outputs=network.outputs[::-1]) for network in quick_model.table[:1]
    )
    assert symmetrised(dataclasses.replace(quick_model, table=(*table, *quick_model.table[1:])))
    odd = Network(region="eyes", name="blink", outputs=("eyeBlinkLeft", "tongueOut"))
    with pytest.raises(InputError, match="one side of the face only"):
        symmetrised(dataclasses.replace(quick_model, table=(odd, *quick_model.table[1:])))


def test_the_commands_take_it(run, quick_model, quick_model_folder, tmp_path):
    np.save(tmp_path / "take.npy", FACES)
    code, out, err = run(
        "predict", quick_model_folder, tmp_path / "take.npy", "--symmetric", "--keep-guessed-gaze"
    )
    assert code == 0, err
    written = np.array([line.split(",")[1:] for line in out.splitlines()[1:]], dtype=float)
    np.testing.assert_allclose(written, symmetrised(quick_model).predict(FACES), atol=1e-6)
    code, _, err = run("export", quick_model_folder, "--symmetric", "--format", "json", "--out", tmp_path)
    assert code == 0, err
    assert '"edges"' in (tmp_path / "face.json").read_text()
