"""Denoising: the noise of a face is found and taken off, in the mirror as well, and a model with it is a model."""

import dataclasses
import hashlib
import json

import numpy as np
import pytest

from facegen.conventions import MIRRORED_LANDMARKS, mirrored_name
from regress.errors import InputError
from regress.learning.networks import fit_denoising
from regress.learning.training import RECIPES, train
from regress.learning.training.noise import displace
from regress.runtime.features import (
    Features,
    closed_under_mirror,
    extract,
    load_reference_shape,
    mirrored_edges,
)
from regress.runtime.model import FastPredictor, Model, load_model, save_model, symmetrised
from regress.runtime.networks import Denoising
from tests.regress.conftest import QUICK
from tests.regress.drawn import drawn_face, in_pictures


def similar_faces(rng: np.random.Generator, count: int) -> np.ndarray:
    """Faces that differ by twelve movements of 1.5 % of their width, as expressions of one person do."""
    modes = rng.normal(size=(12, 68, 2)) * 0.005
    return in_pictures(rng, drawn_face() + np.einsum("nk,kpd->npd", rng.normal(size=(count, 12)), modes))


_DRAWN = similar_faces(np.random.default_rng(3), 2060)
FACES, UNSEEN = _DRAWN[:2000], _DRAWN[2000:]
FEATURES = Features(
    alignment="affine",
    mean_shape=drawn_face() / 2,
    edges=closed_under_mirror(load_reference_shape().edges),
    reference_name="",
    reference_sha256="",
)
PARTNER = mirrored_edges(FEATURES.edges)


def features_of(faces: np.ndarray, size: float = 0.0) -> np.ndarray:
    rng = np.random.default_rng(8)
    return extract(FEATURES, displace(faces, size * rng.standard_normal(faces.shape)))


@pytest.fixture(scope="module")
def denoising() -> Denoising:
    clean = features_of(FACES)
    return fit_denoising(clean, (features_of(FACES, 0.002) - clean) / 0.002, PARTNER)


@pytest.fixture(scope="module")
def model(dataset) -> Model:
    default = RECIPES["default"]
    recipe = dataclasses.replace(
        QUICK, denoise=True, noise=default.noise, calibrated_noise=default.calibrated_noise
    )
    return train(dataset, recipe, seed=3)


def test_every_edge_has_its_partner_once_the_edges_are_closed():
    assert sorted(PARTNER) == list(range(len(FEATURES.edges)))
    np.testing.assert_array_equal(closed_under_mirror(FEATURES.edges), FEATURES.edges)


def test_too_few_faces_are_told():
    clean = features_of(FACES[:12])
    with pytest.raises(InputError, match=r"12 faces are too few .* more people, or train by --recipe exact"):
        fit_denoising(clean, (features_of(FACES[:12], 0.002) - clean) / 0.002, PARTNER)


@pytest.mark.parametrize("size", [0.002, 0.005, 0.01])
def test_noise_is_measured_and_more_of_it_shrinks_more(denoising: Denoising, size: float):
    seen, level = (denoising.shrunk(features_of(UNSEEN, each)) for each in (size, 2 * size))
    told = denoising.signal[-2:] * (1 / seen[:, -2:] - 1) - denoising.least  # what the last two places say
    assert np.sqrt(np.median(told)) == pytest.approx(size, rel=0.25)
    assert (np.abs(seen[:, -2:]) > np.abs(level[:, -2:])).mean() > 0.95


def test_a_face_unlike_those_trained_on_counts_as_noisy(denoising: Denoising):
    # along the axes of expressions alone, so that no noise is measured; four times as far as faces usually go
    spread = np.sqrt(denoising.signal[:-2])
    places = 4 * spread * np.random.default_rng(5).standard_normal((60, len(spread)))
    features = denoising.origin + places @ denoising.back[: len(spread), : len(PARTNER)]
    believed, doubted = denoising.believing.shrunk(features), denoising.shrunk(features)
    assert np.median(denoising.signal[-2] * (1 / believed[:, -2] - 1)) < 1e-5
    expected = denoising.surplus[:-2] @ (16 * denoising.signal[:-2]) - denoising.usual
    assert np.median(denoising.signal[-2] * (1 / doubted[:, -2] - 1)) == pytest.approx(expected, rel=0.3)
    assert (np.abs(doubted) < np.abs(believed)).mean() > 0.95


def test_what_is_left_is_nearer_to_the_undisturbed_face(denoising: Denoising):
    def restored(features: np.ndarray) -> np.ndarray:
        return (denoising.shrunk(features) @ denoising.back)[:, : len(PARTNER)] + denoising.origin

    clean = features_of(UNSEEN)
    for size in (0.002, 0.005, 0.01):
        noisy = features_of(UNSEEN, size)
        assert np.abs(restored(noisy) - clean).mean() < 0.6 * np.abs(noisy - clean).mean()


def test_a_mirrored_face_has_the_same_places_but_for_signs(denoising: Denoising):
    features = features_of(UNSEEN, 0.01)
    places, mirrored = denoising.shrunk(features), denoising.shrunk(features[:, PARTNER])
    np.testing.assert_allclose(np.abs(places), np.abs(mirrored), atol=1e-9)
    signs = np.sign(places * mirrored)
    assert (np.abs(signs.sum(axis=0)) == len(places)).all()
    assert set(signs[0]) == {1.0, -1.0}


def test_a_shifted_filter_acts_on_differences_and_a_missing_face_stays_missing(denoising: Denoising):
    features, origin = features_of(UNSEEN), features_of(UNSEEN)[0] - 0.3
    np.testing.assert_allclose(
        denoising.shifted(origin).shrunk(features), denoising.shrunk(features - origin), atol=1e-9
    )
    features[3] = np.nan
    assert np.isnan(denoising.shrunk(features)).all(axis=1).tolist() == [row == 3 for row in range(60)]


@pytest.mark.parametrize("calibrated", [False, True])
def test_a_model_with_it_is_fast_symmetric_and_saved_like_any_other(calibrated: bool, model: Model, tmp_path):
    image = UNSEEN[:, list(MIRRORED_LANDMARKS)] * [-1, 1]
    straight, other, symmetric = model, model, symmetrised(model)
    if calibrated:
        straight, other = model.calibrate(UNSEEN[:1]), model.calibrate(image[:1])
        symmetric = symmetric.calibrate(UNSEEN[:1])
    partners = [model.outputs.index(mirrored_name(name)) for name in model.outputs]
    mean = (straight.predict_raw(UNSEEN) + other.predict_raw(image)[:, partners]) / 2
    np.testing.assert_allclose(symmetric.predict_raw(UNSEEN), mean, atol=1e-9)
    weights = symmetric.predict(UNSEEN)
    fast = FastPredictor(symmetric)
    np.testing.assert_allclose(fast.predict(UNSEEN), weights, atol=1e-5)
    np.testing.assert_allclose([fast.predict_frame(face) for face in UNSEEN], weights, atol=1e-5)
    save_model(symmetric, tmp_path / "model")
    np.testing.assert_array_equal(load_model(tmp_path / "model").predict(UNSEEN), weights)


def test_models_of_before_know_no_surplus(model: Model, tmp_path):
    folder = tmp_path / "model"
    save_model(model, folder)
    with np.load(folder / "weights.npz") as arrays:
        kept = {name: arrays[name] for name in arrays.files if not name.endswith(("_surplus", "_usual"))}
    np.savez(folder / "weights.npz", **kept)
    document = json.loads((folder / "model.json").read_text())
    document["schema"] = 3
    document["weights_sha256"] = hashlib.sha256((folder / "weights.npz").read_bytes()).hexdigest()
    (folder / "model.json").write_text(json.dumps(document))
    networks = dataclasses.replace(model.networks, denoising=model.networks.denoising.believing)
    expected = dataclasses.replace(model, networks=networks).predict(UNSEEN)
    np.testing.assert_array_equal(load_model(folder).predict(UNSEEN), expected)
