"""Trains only the networks that compare with a neutral face: half the time, for ablations and for other rigs."""

from dataclasses import replace

import numpy as np

from regress import Model
from regress.learning.training.baseline import Baseline
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.gain import SEEN, gain_of, stretched
from regress.learning.training.preparation import OUTPUT_COLUMNS, draw_detected, faces_of
from regress.learning.training.recipes import Recipe
from regress.learning.training.run import beside_neutral, fit_set
from regress.runtime.features import (
    Features,
    closed_under_mirror,
    depths_of,
    load_reference_shape,
    mean_shape,
)
from regress.runtime.model import Calibrated, symmetrised
from regress.targets import NETWORKS, OUTPUTS

_SEED = 27
"""Of the displacements by which gains are found."""


def train_calibrated(dataset: KeypointDataset, recipe: Recipe, seed: int) -> Model:
    """A model of which only the networks that compare are trained."""
    reference = load_reference_shape()
    features = Features(
        alignment=recipe.alignment,
        mean_shape=mean_shape(dataset.points[dataset.rows("train")]),
        edges=closed_under_mirror(reference.edges),
        reference_name=reference.name,
        reference_sha256=reference.sha256,
        depth=depths_of(reference),
    )
    beside = beside_neutral(features, recipe)
    fitted = fit_set(dataset, beside, recipe, calibrated=True, seed=seed, progress=None)
    seen = {"features": beside, "normalisation": fitted.prepared.normalisation, "networks": fitted.networks}
    model = symmetrised(Model(recipe=recipe.name, table=NETWORKS, calibrated=Calibrated(**seen), **seen))
    return stretched(model, dataset) if recipe.calibrated_gain else model


def stretched_ridge(ridge: Baseline, features: Features, dataset: KeypointDataset) -> Baseline:
    """Ridge beside a neutral face, finished as `stretched` finishes networks.

    Its answer to that face is 0, and each shape has the gain with which answers for validation people spread as far as
    their true weights.
    """
    at_rest = replace(
        ridge,
        normalisation=replace(
            ridge.normalisation,
            feature_mean=np.zeros_like(ridge.normalisation.feature_mean),
            target_mean=np.zeros_like(ridge.normalisation.target_mean),
        ),
    )
    faces = draw_detected(
        faces_of(dataset, "validation", calibrated=True), SEEN, np.random.default_rng(_SEED)
    )
    gain = gain_of(at_rest.predict(faces.features(features)), faces.weights[:, OUTPUT_COLUMNS], OUTPUTS)
    return replace(at_rest, coefficients=at_rest.coefficients * gain)
