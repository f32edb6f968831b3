"""Makes a model's training record: figures on the test split, baselines, and how each network's training went."""

import dataclasses

import numpy as np
import scipy

from facegen.conventions import SPLITS
from regress import __version__
from regress.learning.training.baseline import fit_baseline
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.fitting import Fit
from regress.learning.training.noise import DetectorNoise
from regress.learning.training.preparation import OUTPUT_COLUMNS, faces_of
from regress.learning.training.recipes import Recipe
from regress.learning.training.regression import regress_split
from regress.learning.training.scores import detected, evaluate_model, mean_r2, score, score_faces
from regress.runtime.features import Features
from regress.runtime.model import Model, Scores, TrainingRecord
from regress.runtime.model.record import DatasetRecord, ErrorCurves, MeanScores, NetworkTraining
from regress.targets import NETWORKS, OUTPUTS, VISIBLE_SHAPES

DETECTOR = DetectorNoise(bias=1.0, drift=0.0, jitter=0.001, clean=0.0)
"""What the figures ``as_detected`` are measured with: a guess at a tracked face's bias, which stays, and at its jitter.

Real offsets also pass with expressions and turns (`KnownDetector`), which costs more than what stays.
"""

_FLOORS = {
    "ridge": "rows as the dataset has them",
    "ridge_same_rows": "the networks' own rows, displaced faces among them",
    "calibrated_ridge": "rows as the dataset has them, less neutral frames",
    "calibrated_ridge_same_rows": "the calibrated networks' own rows, displaced faces among them",
}
"""What each ridge regression of a record was trained on."""


def training_record(
    model: Model,
    dataset: KeypointDataset,
    recipe: Recipe,
    *,
    seed: int,
    fits: dict[str, Fit],
    training_rows: int,
) -> TrainingRecord:
    """Evaluate a model and its baselines on the test split, and record the training."""
    exact, displaced = _baselines(dataset, model.features, recipe, calibrated=False, seed=seed)
    scores = {"network": evaluate_model(model, dataset), **exact}
    as_detected = {"network": _scores_as_detected(model, dataset, calibrated=False), **displaced}
    if model.calibrated is not None:
        exact, displaced = _baselines(dataset, model.calibrated.features, recipe, calibrated=True, seed=seed)
        scores["calibrated"] = evaluate_model(model, dataset, calibrated=True)
        as_detected["calibrated"] = _scores_as_detected(model, dataset, calibrated=True)
        for known, baselines in ((scores, exact), (as_detected, displaced)):
            known |= {f"calibrated_{name}": shapes for name, shapes in baselines.items() if name != "mean"}
    networks = {name: _network_records(fit) for name, fit in fits.items()}
    return TrainingRecord(
        recipe={**dataclasses.asdict(recipe), "alphas": list(recipe.alphas)},
        seed=seed,
        dataset=DatasetRecord(
            name=dataset.name,
            spec_hash=dataset.description.get("spec_hash"),
            keypoints_sha256=dataset.sha256,
            rig=dataset.description.get("rig", dataset.description.get("rigs")),
            licence=dataset.description.get("licence"),
            samples={split: len(dataset.rows(split)) for split in SPLITS},
            people=len(np.unique(dataset.person)),
            people_in_training={split: _people_in_training(dataset, split) for split in SPLITS[1:]},
        ),
        training_rows=training_rows,
        licence="Apache-2.0",
        versions={"regress": __version__, "numpy": np.__version__, "scipy": scipy.__version__},
        floors={name: text for name, text in _FLOORS.items() if name in scores},
        summary={name: _summary(shapes) for name, shapes in scores.items()},
        as_detected={name: _summary(shapes) for name, shapes in as_detected.items()},
        scores={shape: {name: shapes[shape] for name, shapes in scores.items()} for shape in OUTPUTS},
        regression={split: regress_split(model, dataset, split=split) for split in SPLITS},
        networks=networks["alone"],
        calibrated_networks=networks.get("calibrated"),
    )


def _people_in_training(dataset: KeypointDataset, split: str) -> int:
    """How many people of a split are in training too: none where splits are by person, most where by session."""
    held_out, trained = (np.unique(dataset.person[dataset.rows(name)]) for name in (split, "train"))
    return int(np.isin(held_out, trained).sum())


def _summary(shapes: dict[str, Scores]) -> MeanScores:
    return MeanScores(
        mean_r2=mean_r2(shapes, OUTPUTS),
        mean_r2_visible=mean_r2(shapes, VISIBLE_SHAPES),
        mean_r2_networks=_mean_over_networks(shapes),
    )


def _scores_as_detected(model: Model, dataset: KeypointDataset, *, calibrated: bool) -> dict[str, Scores]:
    return score_faces(model, detected(faces_of(dataset, "test", calibrated=calibrated), DETECTOR))


def _baselines(
    dataset: KeypointDataset, features: Features, recipe: Recipe, *, calibrated: bool, seed: int
) -> tuple[dict[str, dict[str, Scores]], dict[str, dict[str, Scores]]]:
    """Ridge on the same features, its strength chosen per shape, and the training mean; clipped.

    On faces as the dataset has them; and, without the mean, on faces as a detector may put them.
    """
    noise = recipe.calibrated_noise if calibrated else recipe.noise
    ridge = fit_baseline(dataset, features, mirror=recipe.mirror, calibrated=calibrated)
    faces = faces_of(dataset, "test", calibrated=calibrated)
    ridges = {"ridge": ridge}
    if noise is not None:
        ridges["ridge_same_rows"] = fit_baseline(
            dataset, features, mirror=recipe.mirror, noise=noise, calibrated=calibrated, seed=seed
        )
    true = faces.weights[:, OUTPUT_COLUMNS]

    def scored(weights: np.ndarray) -> dict[str, Scores]:
        return dict(zip(OUTPUTS, score(weights, true), strict=True))

    exact, displaced = (
        {name: scored(one.predict(given.features(features))) for name, one in ridges.items()}
        for given in (faces, detected(faces, DETECTOR))
    )
    return exact | {"mean": scored(np.broadcast_to(ridge.normalisation.target_mean, true.shape))}, displaced


def _mean_over_networks(scores: dict[str, Scores]) -> float | None:
    """Mean over the networks of the mean R2 of their outputs: two-sided shapes count once."""
    means = [mean_r2(scores, network.outputs) for network in NETWORKS]
    defined = [mean for mean in means if mean is not None]
    return float(np.mean(defined)) if defined else None


def _network_records(fit: Fit) -> dict[str, NetworkTraining]:
    """How each network's training went; errors are mean squares of z-scored targets."""
    records: dict[int, NetworkTraining] = {}
    for group, result in zip(fit.groups, fit.results, strict=True):
        for row, number in enumerate(group):
            steps = int(result.steps[row])
            errors = result.monitored[: steps + 1, row]
            # Padding of one-output networks counts as zeros in the mean over K: undo it.
            padding = fit.layout.outputs / len(NETWORKS[number].outputs)
            records[int(number)] = NetworkTraining(
                alpha=float(fit.alphas[number]),
                search=dict(zip(map(str, fit.tried), fit.search_errors[:, number].tolist(), strict=True)),
                outcome=result.outcomes[row].name,
                reason=result.outcomes[row].value,
                steps=steps,
                best_step=int(result.best_step[row]),
                curves=ErrorCurves(
                    train=(result.residual_square[: steps + 1, row] * padding).tolist(),
                    validation=errors[:, 0].tolist(),
                    test=errors[:, 1].tolist(),
                ),
            )
    return {network.key: records[number] for number, network in enumerate(NETWORKS)}
