"""Fits ridge regression on a model's own features: the baseline that every network must beat."""

from dataclasses import dataclass

import numpy as np

from regress.learning.networks import fit_ridge
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.noise import DetectorNoise
from regress.learning.training.preparation import prepare
from regress.runtime.features import Features
from regress.runtime.model import Normalisation


@dataclass(frozen=True, kw_only=True)
class Baseline:
    """A linear map from features to weights.

    Parameters
    ----------
    normalisation
        Of the rows it was fitted to.
    coefficients : (E, O) float64
        From z-scored features to z-scored weights.
    strengths : (O,) float64
        Of each shape.
    """

    normalisation: Normalisation
    coefficients: np.ndarray
    strengths: np.ndarray

    def predict(self, features: np.ndarray) -> np.ndarray:
        """Weights (n, O) in ``OUTPUTS`` order, clipped to [0, 1], of raw features (n, E)."""
        scores = self.normalisation
        standard = (features - scores.feature_mean) / scores.feature_std
        return np.clip(standard @ self.coefficients * scores.target_std + scores.target_mean, 0, 1)


def fit_baseline(
    dataset: KeypointDataset,
    features: Features,
    *,
    mirror: bool,
    noise: DetectorNoise | None = None,
    calibrated: bool = False,
    seed: int = 0,
) -> Baseline:
    """Ridge on the rows that :func:`prepare` gives to networks, its strength chosen per shape on validation."""
    prepared = prepare(dataset, features, mirror=mirror, noise=noise, calibrated=calibrated, seed=seed)
    train, validation = prepared.splits["train"], prepared.splits["validation"]
    ridge = fit_ridge(train.inputs, train.targets, validation.inputs, validation.targets)
    return Baseline(
        normalisation=prepared.normalisation,
        coefficients=prepared.rotation @ ridge.coefficients,
        strengths=ridge.strengths,
    )
