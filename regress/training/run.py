"""Training from start to model: features, networks, baselines, and the record of it all."""

import dataclasses
from typing import Any

import numpy as np
import scipy

from regress import __version__
from regress.features import Features, load_reference_shape, mean_shape
from regress.model import Model
from regress.networks import fit_ridge, fold
from regress.targets import NETWORKS, OUTPUTS, VISIBLE_SHAPES
from regress.training.dataset import KeypointDataset
from regress.training.fitting import Fit, Progress, fit_networks
from regress.training.preparation import OUTPUT_COLUMNS, Prepared, prepare
from regress.training.recipes import Recipe
from regress.training.regression import regress_split
from regress.training.scores import Scores, evaluate_model, mean_r2, score


def train(
    dataset: KeypointDataset, recipe: Recipe, *, seed: int = 0, progress: Progress | None = None
) -> Model:
    """Train all networks on a dataset; the same inputs give the same model on one machine.

    Parameters
    ----------
    dataset
        Points, weights and splits.
    recipe
        One of ``RECIPES``, or another.
    seed
        Of the starts and of the rows on which alphas are compared.
    progress
        Called as work goes on, from any thread.
    """
    reference = load_reference_shape()
    features = Features(
        alignment=recipe.alignment,
        mean_shape=mean_shape(dataset.points[dataset.rows("train")]),
        edges=reference.edges,
        reference_name=reference.name,
        reference_sha256=reference.sha256,
    )
    prepared = prepare(dataset, features, mirror=recipe.mirror)
    fit = fit_networks(prepared, recipe, seed=seed, progress=progress)
    normalisation = prepared.normalisation
    model = Model(
        recipe=recipe.name,
        table=NETWORKS,
        features=features,
        normalisation=normalisation,
        networks=fold(
            fit.layout,
            fit.parameters,
            outputs=tuple(len(network.outputs) for network in NETWORKS),
            rotation=prepared.rotation,
            input_mean=normalisation.feature_mean,
            input_std=normalisation.feature_std,
            target_mean=normalisation.target_mean,
            target_std=normalisation.target_std,
        ),
        record={},
    )
    return dataclasses.replace(model, record=_record(model, dataset, recipe, seed, prepared, fit))


def _record(
    model: Model, dataset: KeypointDataset, recipe: Recipe, seed: int, prepared: Prepared, fit: Fit
) -> dict[str, Any]:
    scores = {"network": evaluate_model(model, dataset), **_baselines(dataset, prepared)}
    return {
        "recipe": {**dataclasses.asdict(recipe), "alphas": list(recipe.alphas)},
        "seed": seed,
        "dataset": {
            "name": dataset.name,
            "spec_hash": dataset.description.get("spec_hash"),
            "keypoints_sha256": dataset.sha256,
            "rig": dataset.description.get("rig"),
            "licence": dataset.description.get("licence"),
            "samples": {split: len(dataset.rows(split)) for split in prepared.splits},
            "people": len(np.unique(dataset.person)),
        },
        "training_rows": len(prepared.splits["train"].inputs),
        "licence": "Apache-2.0",
        "versions": {
            "regress": __version__,
            "numpy": np.__version__,
            "scipy": scipy.__version__,
        },
        "summary": {
            name: {
                "mean_r2": mean_r2(shapes, OUTPUTS),
                "mean_r2_visible": mean_r2(shapes, VISIBLE_SHAPES),
                "mean_r2_networks": _mean_over_networks(shapes),
            }
            for name, shapes in scores.items()
        },
        "scores": {
            shape: {name: dataclasses.asdict(shapes[shape]) for name, shapes in scores.items()}
            for shape in OUTPUTS
        },
        "regression": {
            split: dataclasses.asdict(regress_split(model, dataset, split=split)) for split in prepared.splits
        },
        "networks": _network_records(recipe, fit),
    }


def _baselines(dataset: KeypointDataset, prepared: Prepared) -> dict[str, dict[str, Scores]]:
    """Ridge on the same features and rows, its strength chosen per shape, and the training mean; clipped."""
    train, validation, test = (prepared.splits[name] for name in ("train", "validation", "test"))
    normalisation = prepared.normalisation
    ridge = fit_ridge(train.inputs, train.targets, validation.inputs, validation.targets)
    predicted = test.inputs @ ridge.coefficients * normalisation.target_std + normalisation.target_mean
    true = dataset.weights[dataset.rows("test")][:, OUTPUT_COLUMNS]
    mean = np.broadcast_to(normalisation.target_mean, true.shape)
    return {
        "ridge": dict(zip(OUTPUTS, score(np.clip(predicted, 0, 1), true), strict=True)),
        "mean": dict(zip(OUTPUTS, score(mean, true), strict=True)),
    }


def _mean_over_networks(scores: dict[str, Scores]) -> float | None:
    """Mean over the networks of the mean R2 of their outputs: two-sided shapes count once."""
    means = [mean_r2(scores, network.outputs) for network in NETWORKS]
    known = [mean for mean in means if mean is not None]
    return float(np.mean(known)) if known else None


def _network_records(recipe: Recipe, fit: Fit) -> dict[str, Any]:
    """How each network's training went; errors are mean squares of z-scored targets."""
    records: dict[int, Any] = {}
    for group, result in zip(fit.groups, fit.results, strict=True):
        for row, number in enumerate(group):
            steps = int(result.steps[row])
            errors = result.monitored[: steps + 1, row]
            # Padding of one-output networks counts as zeros in the mean over K: undo it.
            padding = fit.layout.outputs / len(NETWORKS[number].outputs)
            records[int(number)] = {
                "alpha": float(fit.alphas[number]),
                "search": dict(
                    zip(map(str, recipe.alphas), fit.search_errors[:, number].tolist(), strict=True)
                ),
                "outcome": result.outcomes[row].name,
                "reason": result.outcomes[row].value,
                "steps": steps,
                "best_step": int(result.best_step[row]),
                "curves": {
                    "train": (result.residual_square[: steps + 1, row] * padding).tolist(),
                    "validation": errors[:, 0].tolist(),
                    "test": errors[:, 1].tolist(),
                },
            }
    return {network.key: records[number] for number, network in enumerate(NETWORKS)}
