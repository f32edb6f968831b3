"""Trains only the networks that compare with a neutral face: half the time, for ablations and for other rigs."""

from regress import Model
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.gain import stretched
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
from regress.targets import NETWORKS


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
