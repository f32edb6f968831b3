"""The fast predictor says what the model says."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regress.errors import InputError
from regress.runtime.features import depths_of, load_reference_shape
from regress.runtime.model import FastPredictor, Model

AGREE = 1e-5


@pytest.fixture(scope="module", params=["turn", "affine", "none", "stable"])
def model(request, quick_model: Model, stable_model: Model) -> Model:
    """The weights fit one kind of features, which does not matter here: both must say the same."""
    if request.param == "stable":
        return stable_model.calibrate(stable_model.features.mean_shape[None] + 0.01)
    features = dataclasses.replace(
        quick_model.features,
        alignment="none" if request.param == "none" else "affine",
        depth=depths_of(load_reference_shape()) if request.param == "turn" else None,
    )
    return dataclasses.replace(quick_model, features=features)


def check_same(model: Model, points: np.ndarray) -> None:
    fast, wanted = FastPredictor(model), model.predict(points)
    np.testing.assert_allclose(fast.predict(points), wanted, atol=AGREE)
    np.testing.assert_allclose([fast.predict_frame(face) for face in points], wanted, atol=AGREE)


@given(seed=st.integers(0, 2**32 - 1), size=st.floats(1e-3, 1e3), shift=st.floats(-30, 30))
@settings(max_examples=40, deadline=None)
def test_faces_of_any_size_and_place(model: Model, seed: int, size: float, shift: float):
    rng = np.random.default_rng(seed)
    faces = model.features.mean_shape + rng.normal(size=(3, 68, 2)) * 0.02
    check_same(model, (faces + shift) * size)


def test_batches_of_more_than_a_block(model: Model, dataset):
    points = np.resize(dataset.points, (1100, 68, 2))
    check_same(model, points)


def test_threads_change_no_bit(quick_model: Model, dataset):
    points = np.resize(dataset.points, (8 * 512 + 3, 68, 2)).copy()
    points[4000, 3] = np.nan
    fast = FastPredictor(quick_model)
    np.testing.assert_array_equal(fast.predict(points, threads=3), fast.predict(points, threads=1))
    np.testing.assert_allclose(fast.predict(points), quick_model.predict(points), atol=AGREE)


def test_missing_points_and_faces_without_extent_give_rows_of_nan_and_spare_their_neighbours(
    model: Model, dataset
):
    points = dataset.points[:6].copy()
    points[1, 30, 0] = np.nan
    points[2, 50, 1] = np.inf
    points[3] = points[3, :1]
    check_same(model, points)
    assert np.isnan(FastPredictor(model).predict(points)[1:4]).all()


def test_collinear_faces_have_no_map(quick_model: Model, dataset):
    points = dataset.points[:2].copy()
    points[0, :, 1] = 2 * points[0, :, 0] + 7
    weights = FastPredictor(quick_model).predict(points)
    assert np.isnan(weights[0]).all()
    assert np.isfinite(weights[1]).all()
    assert np.isnan(FastPredictor(quick_model).predict_frame(points[0])).all()


@pytest.mark.parametrize("slope", [0.0, 0.3, -1.7])
def test_lines_whose_moments_round_to_less_than_nothing_have_no_map(
    quick_model: Model, dataset, slope: float
):
    points = dataset.points[:40].copy()
    points[:, :, 1] = slope * points[:, :, 0] + 7
    assert np.isnan(FastPredictor(quick_model).predict(points)).all()


def test_a_point_at_infinity_leaves_no_weight_where_sums_cannot_cancel(model: Model, dataset):
    networks = dataclasses.replace(model.networks, w1=np.abs(model.networks.w1))
    points = dataset.points[:3].copy()
    points[1, 50, 1] = np.inf
    check_same(dataclasses.replace(model, networks=networks), points)


def test_results_stay_when_the_next_frame_comes(quick_model: Model, dataset):
    fast = FastPredictor(quick_model)
    first = fast.predict_frame(dataset.points[0])
    kept = first.copy()
    fast.predict_frame(dataset.points[1])
    np.testing.assert_array_equal(first, kept)


def test_other_shapes_are_refused(quick_model: Model):
    with pytest.raises(InputError, match=r"\(68, 2\) is needed"):
        FastPredictor(quick_model).predict_frame(np.zeros((67, 2)))
    with pytest.raises(InputError, match=r"\(n, 68, 2\) is needed"):
        FastPredictor(quick_model).predict(np.zeros((68, 2)))
