"""Counts and fits of predicted against true weights."""

import numpy as np
import pytest

from regress.learning.training.regression import CELLS, regression


def test_every_value_counts_once_where_it_belongs():
    true = np.array([[0.0, 0.5, 1.0], [0.0, 0.009, 0.2]])
    predicted = np.array([[0.0, 0.5, 1.0], [-0.3, 1.2, 0.8]])
    counts = np.array(regression(predicted, true).counts)
    assert counts.shape == (CELLS, CELLS)
    assert counts.sum() == true.size
    assert (counts[0, 0], counts[25, 25], counts[50, 50], counts[0, 50], counts[10, 40]) == (2, 1, 1, 1, 1)


def test_fit_is_the_least_squares_line():
    rng = np.random.default_rng(0)
    true = rng.uniform(size=400)
    predicted = 0.8 * true + 0.1 + rng.normal(size=400) * 0.05
    found = regression(predicted, true)
    assert (found.slope, found.intercept) == pytest.approx(tuple(np.polyfit(true, predicted, 1)))
    assert found.pearson == pytest.approx(np.corrcoef(true, predicted)[0, 1])


def test_weights_that_never_move_have_no_fit():
    found = regression(np.linspace(0, 1, 5), np.zeros(5))
    assert (found.slope, found.intercept, found.pearson) == (None, None, None)
