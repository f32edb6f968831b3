"""A share of ridge regression in networks: what is answered, and that a plane stays one."""

import dataclasses

import numpy as np
import pytest

from regress.learning.training import KeypointDataset
from regress.learning.training.baseline import Baseline
from regress.learning.training.linear_share import with_linear_share
from regress.learning.training.recipes import Recipe
from regress.learning.training.run import train
from regress.runtime.model import Model, Normalisation
from regress.runtime.networks import evaluate
from regress.targets import OUTPUTS


@pytest.fixture(scope="module")
def plane(quick_model: Model) -> Baseline:
    """A plane on the model's features that answers within a few of its standard deviations."""
    rng = np.random.default_rng(3)
    count = quick_model.features.count
    return Baseline(
        normalisation=Normalisation(
            feature_mean=rng.normal(size=count),
            feature_std=rng.uniform(0.5, 2, count),
            target_mean=rng.uniform(0, 0.3, len(OUTPUTS)),
            target_std=rng.uniform(0.05, 0.3, len(OUTPUTS)),
        ),
        coefficients=rng.normal(size=(count, len(OUTPUTS))) / np.sqrt(count),
        strengths=np.ones(len(OUTPUTS)),
    )


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_each_output_is_the_mean_of_both_by_their_shares(share: float, quick_model: Model, plane: Baseline):
    networks, scores = quick_model.networks, plane.normalisation
    features = scores.feature_mean + scores.feature_std * np.random.default_rng(4).normal(
        size=(200, quick_model.features.count)
    )
    z = (features - scores.feature_mean) / scores.feature_std @ plane.coefficients
    expected = (1 - share) * evaluate(networks, features) + share * (
        scores.target_mean + scores.target_std * z
    )
    found = evaluate(with_linear_share(networks, plane, share), features)
    # tanh bends by z^3 / 1200: by 2 % of a weight that is 5 standard deviations off
    np.testing.assert_allclose(found, expected, atol=1e-9 + share * 0.3 * np.abs(z).max() ** 3 / 1200)
    assert np.corrcoef(found.ravel(), expected.ravel())[0, 1] > 0.9999


def test_a_recipe_s_share_is_in_the_networks_that_compare_alone(dataset: KeypointDataset):
    quick = Recipe(name="quick", alphas=(0.3,), steps=4, search_rows=150, hidden=6)
    plain, shared = (
        train(dataset, dataclasses.replace(quick, calibrated_linear=share), seed=1) for share in (0.0, 0.4)
    )
    np.testing.assert_array_equal(shared.networks.w1, plain.networks.w1)
    own, more = plain.calibrated.networks, shared.calibrated.networks
    assert more.hidden == own.hidden + 2
    assert more.w2.shape == (len(OUTPUTS), more.hidden)
