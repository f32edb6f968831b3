"""Lists the methods that probes compare: a model's networks, and the two ridge regressions that are their baselines."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from regress.learning.training.baseline import fit_baseline
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.detectors import noise_of
from regress.learning.training.noise import DetectorNoise
from regress.learning.training.scores import predicted_outputs
from regress.runtime.features import extract
from regress.runtime.model import Model


@dataclass(frozen=True, kw_only=True)
class Method:
    """One way from points to weights.

    Parameters
    ----------
    name
        ``"networks"``, ``"ridge, same rows"`` (trained on the very rows that the networks saw, displaced faces
        and all) or ``"ridge, undisplaced rows"`` (on the rows as the dataset has them). The first is the floor of
        a comparison at any level of noise; the second shows what linear regression does where points are exact.
    calibrated
        Whether it compares a frame with the person's neutral one.
    predict
        From points and neutral points, both (n, 68, 2), to weights (n, O) in the networks' order, clipped;
        the neutral points are ignored where not ``calibrated``.
    """

    name: str
    calibrated: bool
    predict: Callable[[np.ndarray, np.ndarray], np.ndarray]


def networks_of(model: Model) -> tuple[Method, ...]:
    """A model's networks: for a frame alone and, where it has them, beside a neutral frame."""

    def alone(points: np.ndarray, neutral: np.ndarray) -> np.ndarray:
        return predicted_outputs(model, points)

    def beside(points: np.ndarray, neutral: np.ndarray) -> np.ndarray:
        return predicted_outputs(model, points, neutral)

    methods = (Method(name="networks", calibrated=False, predict=alone),)
    if model.calibrated is None:
        return methods
    return (*methods, Method(name="networks", calibrated=True, predict=beside))


def ridges_of(model: Model, dataset: KeypointDataset) -> tuple[Method, ...]:
    """The floors of a model's networks, trained on the dataset that the networks were trained on."""
    recipe = model.record.recipe
    methods = []
    for calibrated in (False, True)[: 1 if model.calibrated is None else 2]:
        noise = recipe["calibrated_noise" if calibrated else "noise"]
        kinds = {"ridge, undisplaced rows": None}
        if noise is not None:
            kinds = {"ridge, same rows": noise_of(noise), **kinds}
        for name, displaced in kinds.items():
            methods.append(_ridge(model, dataset, name, noise=displaced, calibrated=calibrated))
    return tuple(methods)


def _ridge(
    model: Model, dataset: KeypointDataset, name: str, *, noise: DetectorNoise | None, calibrated: bool
) -> Method:
    features = model.calibrated.features if calibrated else model.features
    ridge = fit_baseline(
        dataset,
        features,
        mirror=model.record.recipe["mirror"],
        noise=noise,
        calibrated=calibrated,
        seed=model.record.seed,
    )

    def predict(points: np.ndarray, neutral: np.ndarray) -> np.ndarray:
        values = extract(features, points)
        return ridge.predict(values - extract(features, neutral) if calibrated else values)

    return Method(name=name, calibrated=calibrated, predict=predict)
