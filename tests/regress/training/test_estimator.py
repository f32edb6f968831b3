"""The estimator: scikit-learn's own checks, and what it is for."""

import numpy as np
import pytest
from sklearn.base import clone
from sklearn.model_selection import GridSearchCV, cross_val_score
from sklearn.utils.estimator_checks import parametrize_with_checks

from regress import LevenbergMarquardtRegressor


@parametrize_with_checks(
    [LevenbergMarquardtRegressor(), LevenbergMarquardtRegressor(alpha="evidence", hidden=4)]
)
def test_scikit_learns_checks_pass(estimator, check):
    check(estimator)


def waves(rows: int, noise: float = 0.0, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    weights = np.random.default_rng(7).normal(size=(4, 2))
    rng = np.random.default_rng(seed)
    x = rng.normal(size=(rows, 4))
    y = np.tanh(x @ weights)
    return x, y + noise * rng.normal(size=y.shape)


def test_it_works_in_scikit_learns_searches():
    x, y = waves(300)
    network = LevenbergMarquardtRegressor(hidden=8, alpha=0.1)
    assert cross_val_score(clone(network), x, y, cv=2).min() > 0.9
    search = GridSearchCV(network, {"hidden": [1, 8]}, cv=2).fit(x, y)
    assert search.best_params_ == {"hidden": 8}
    assert network.fit(x, y[:, 0]).predict(x).shape == (300,)
    assert network.result_.outcomes[0].value.endswith(".")


def test_the_best_of_several_strengths_is_kept():
    x, y = waves(200, noise=1.0)
    network = LevenbergMarquardtRegressor(alpha=(1e-3, 1.0, 1e5)).fit(x, y)
    assert network.alpha_ == (1e-3, 1.0, 1e5)[int(np.argmin(network.result_.error))]
    assert network.error_ == pytest.approx(network.result_.error.min())
    assert network.alpha_ < 1e5


def test_evidence_sees_how_noisy_targets_are():
    x_new, y_new = waves(2000, seed=99)
    quiet, noisy = (
        LevenbergMarquardtRegressor(alpha="evidence").fit(*waves(150, noise)) for noise in (0.03, 0.6)
    )
    assert quiet.alpha_ < noisy.alpha_ / 10
    assert quiet.score(x_new, y_new) > 0.98
    assert noisy.score(x_new, y_new) > 0.8


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"hidden": 0}, "hidden is 0"),
        ({"steps": 2.5}, "steps is 2.5"),
        ({"alpha": "best"}, "alpha is 'best'"),
        ({"alpha": (1.0, -1.0)}, "0 or more"),
        ({"validation_fraction": 1.0}, "validation_fraction is 1.0"),
    ],
)
def test_what_cannot_be_used_is_refused(parameters: dict, message: str):
    x, y = waves(20)
    with pytest.raises(ValueError, match=message):
        LevenbergMarquardtRegressor(**parameters).fit(x, y)


@pytest.mark.parametrize("copies", ["a constant", "twice another"])
def test_no_strength_at_all_bears_columns_that_say_nothing_new(copies: str):
    rng = np.random.default_rng(0)
    inputs = rng.normal(size=(400, 5))
    targets = np.sin(inputs[:, :1]) + 0.1 * rng.normal(size=(400, 1))
    more = np.ones(400) if copies == "a constant" else 2 * inputs[:, 1]
    inputs = np.column_stack([inputs, more])
    network = LevenbergMarquardtRegressor(hidden=8, alpha=(0.0, 1.0))
    network.fit(inputs[:300], targets[:300])
    assert np.corrcoef(network.predict(inputs[300:]).ravel(), targets[300:].ravel())[0, 1] > 0.9


def test_a_column_of_equal_values_counts_for_nothing():
    """Their spread is rounding, 1e-17 of .1 in a thousand rows: what is divided by it saturates every unit."""
    rng = np.random.default_rng(0)
    inputs = np.column_stack([rng.normal(size=300), np.full(300, 0.1)])
    model = LevenbergMarquardtRegressor(hidden=3).fit(inputs, inputs[:, :1] ** 2)
    moved = inputs + np.array([0.0, 0.1])
    np.testing.assert_allclose(model.predict(moved), model.predict(inputs), atol=0.2)
