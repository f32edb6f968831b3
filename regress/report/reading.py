"""Turns a model's training record into a report's content."""

import math
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPES, SPLITS
from regress.errors import ModelError
from regress.report.content import (
    SEEN_R2,
    Accuracy,
    CalibrationRow,
    Figures,
    Headline,
    LearningCurve,
    RegressionPlot,
    ReportContent,
    ShapeScores,
    mean_curve,
)
from regress.runtime.model import Model, Regression, Scores, TrainingRecord
from regress.runtime.model.record import MeanScores, NetworkTraining
from regress.targets import VISIBLE_SHAPES

DELAUNAY_EDGES = 178
"""Of the reference shape; one of them has no mirror image among them, so symmetric networks see 179."""

_DETECTED = "as a detector is guessed to put them"


def content_of(model: Model) -> ReportContent:
    """Read everything a report says from a model.

    Raises
    ------
    ModelError
        The model was not trained by ``regress train``, so its record lacks the figures.
    """
    record = model.record
    if record is None:
        raise ModelError(
            "the model has no training record: a report needs the figures that `regress train` writes into model.json"
        )
    try:
        scores = tuple(
            _scores(record.scores[output], output, network.region)
            for network in model.table
            for output in network.outputs
        )
        curves = tuple(_curve(network.key, record.networks[network.key]) for network in model.table)
        # records of older models do not say; theirs were split by person as a rule
        in_training = record.dataset.people_in_training.get("test", 0)
        unseen = "faces" if in_training else "people"
        return ReportContent(
            title=f"Model report: {model.recipe} recipe",
            summary=_summary(model, in_training),
            unseen=unseen,
            people_in_training=in_training,
            accuracy=_accuracy(record),
            headlines=_headlines(record, scores, unseen),
            scores=scores,
            constant=tuple(name for name in BLENDSHAPES if name not in model.outputs),
            curve=mean_curve(curves),
            curves=curves,
            noisy_training=record.recipe["noise"] is not None,
            floor=getattr(record.summary.get("ridge_same_rows"), "mean_r2_visible", None),
            regressions=tuple(_regression(split, record.regression[split]) for split in SPLITS),
            calibration=_calibration(record),
            provenance=_provenance(model),
        )
    except KeyError as error:
        raise ModelError(
            f"the model's record has no {error}: a report needs the figures that `regress train` writes into "
            f"model.json"
        ) from error


def _scores(scores: dict[str, Scores], name: str, region: str) -> ShapeScores:
    methods = {
        method: Figures(**{figure: _number(value) for figure, value in vars(scores[method]).items()})
        for method in ("network", "ridge", "mean")
    }
    return ShapeScores(name=name, region=region, **methods)


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def _curve(name: str, network: NetworkTraining) -> LearningCurve:
    series = {split: np.array(errors, dtype=float) for split, errors in vars(network.curves).items()}
    return LearningCurve(name=name, best_step=network.best_step, **series)


def _regression(split: str, regression: Regression) -> RegressionPlot:
    return RegressionPlot(
        split=split,
        counts=np.array(regression.counts),
        slope=_number(regression.slope),
        intercept=_number(regression.intercept),
        pearson=_number(regression.pearson),
    )


def _summary(model: Model, in_training: int) -> str:
    samples = model.record.dataset.samples
    whose = f"people of whom {in_training:,} are in training too" if in_training else ""
    return (
        f"{len(model.table)} networks turn 68 facial landmarks into {len(model.outputs)} avatar weights. "
        f"Trained on {samples['train']:,} synthetic faces, judged on {samples['test']:,} faces of "
        f"{whose or 'people they have never seen'}."
    )


def _headlines(record: TrainingRecord, scores: tuple[ShapeScores, ...], unseen: str) -> tuple[Headline, ...]:
    visible = [score for score in scores if score.name in VISIBLE_SHAPES]
    ridge, all_r2, all_ridge = (
        f"{_number(getattr(record.summary[method], figure)):.3f}"
        for figure, method in (
            ("mean_r2_visible", "ridge"),
            ("mean_r2", "network"),
            ("mean_r2", "ridge"),
        )
    )
    mae, mean_mae = (
        f"{np.mean([getattr(score, method).mae for score in visible]):.3f}" for method in ("network", "mean")
    )
    seen = sum(score.grade == "seen" for score in scores)
    return (
        Headline(value=ridge, caption=f"mean R² of the {len(visible)} visible shapes by ridge regression"),
        Headline(value=all_r2, caption=f"mean R² of all {len(scores)} shapes; ridge regression {all_ridge}"),
        Headline(
            value=mae, caption=f"mean absolute error of a visible shape's weight; always the mean {mean_mae}"
        ),
        Headline(value=f"{seen} of {len(scores)}", caption=f"shapes reach R² {SEEN_R2} on unseen {unseen}"),
    )


def _accuracy(record: TrainingRecord) -> tuple[Accuracy, ...]:
    def visible(scores: dict[str, MeanScores], *methods: str) -> float:
        """Of the first method that was measured."""
        found = next((scores[method] for method in methods if method in scores), None)
        return _number(getattr(found, "mean_r2_visible", None))

    kinds = (
        ("exact points", record.summary, ("ridge",)),
        (_DETECTED, record.as_detected, ("ridge_same_rows", "ridge")),
    )
    return tuple(
        Accuracy(
            points=points,
            alone=visible(found, "network"),
            calibrated=visible(found, "calibrated"),
            alone_ridge=visible(found, *ridges),
            calibrated_ridge=visible(found, *(f"calibrated_{name}" for name in ridges)),
        )
        for points, found, ridges in kinds
        if found
    )


def _calibration(record: TrainingRecord) -> tuple[CalibrationRow, ...]:
    if "calibrated" not in record.summary:
        return ()
    return tuple(
        CalibrationRow(
            landmarks=landmarks,
            shapes=shapes,
            alone=_number(getattr(figures["network"], key)),
            calibrated=_number(getattr(figures["calibrated"], key)),
        )
        for landmarks, figures in (
            ("as in the dataset", record.summary),
            (_DETECTED, record.as_detected),
        )
        for shapes, key in (("visible shapes", "mean_r2_visible"), ("all shapes", "mean_r2"))
    )


def _provenance(model: Model) -> tuple[tuple[str, str], ...]:
    record, dataset = model.record, model.record.dataset
    samples = ", ".join(f"{count:,} {split}" for split, count in dataset.samples.items())
    recipe = ", ".join(
        f"{key.replace('_', ' ')} {_as_text(value)}" for key, value in record.recipe.items() if key != "name"
    )
    return (
        ("dataset", f"{dataset.name} ({samples}; {dataset.people:,} people)"),
        ("spec hash", _as_text(dataset.spec_hash)),
        ("keypoints SHA-256", dataset.keypoints_sha256),
        *_rig(dataset.rig),
        ("licence of the data", _as_text(dataset.licence)),
        ("licence of the model", record.licence),
        ("recipe", f"{model.recipe}: {recipe}"),
        ("training rows", f"{record.training_rows:,}"),
        ("distances", _distances(model)),
        ("hidden units", _hidden_units(model)),
        ("edges SHA-256", model.features.reference_sha256),
        ("seed", str(record.seed)),
        ("ways networks ended", _outcomes(record.networks)),
        ("versions", ", ".join(f"{name} {version}" for name, version in record.versions.items())),
    )


def _distances(model: Model) -> str:
    """How many distances the networks see of a frame, and why so many."""
    count, beside = len(model.features.edges), model.calibrated
    why = "edges"
    if count == DELAUNAY_EDGES:
        why = "the edges of the Delaunay triangulation"
    elif count == DELAUNAY_EDGES + 1:
        why = f"the {DELAUNAY_EDGES} edges of the Delaunay triangulation, and a mirror image for the one without"
    text = f"{count} of a frame: {why} of {model.features.reference_name}"
    if beside is not None and not len(beside.features.edges):
        text += "; beside a neutral face the networks see how far the points moved instead"
    return text


def _hidden_units(model: Model) -> str:
    """How many a network has, and why a symmetric one runs twice as many."""
    trained, run = model.record.recipe["hidden"], len(model.networks.b1) // len(model.table)
    if run == trained:
        return f"{trained} a network"
    return f"{trained} trained a network, {run} run: each is averaged with its own mirror image"


def _rig(rig: Any) -> tuple[tuple[str, str], ...]:
    """A row for each thing a dataset says of its rig or rigs: attribution is among them."""
    if isinstance(rig, dict):
        return tuple((f"rig {key.replace('_', ' ')}", _as_text(value)) for key, value in rig.items())
    if isinstance(rig, list):  # of several, each person has one
        return tuple(row for each in rig for row in _rig(each))
    return (("rig", _as_text(rig)),)


def _outcomes(networks: dict[str, NetworkTraining]) -> str:
    outcomes = [network.outcome for network in networks.values()]
    return ", ".join(
        f"{outcomes.count(outcome)} {outcome.lower().replace('_', ' ')}" for outcome in sorted(set(outcomes))
    )


def _as_text(value: Any) -> str:
    """A value of the record in words."""
    if value is None:
        return "not stated"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        return " ".join(f"{key} {_as_text(entry)}" for key, entry in value.items())
    if isinstance(value, list | tuple):
        return " / ".join(map(_as_text, value))
    return str(value)
