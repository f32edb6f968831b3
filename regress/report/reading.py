"""A model's training record as a report's content."""

import math
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPES, SPLITS
from regress.errors import ModelError
from regress.report.content import (
    SEEN_R2,
    CalibrationRow,
    Figures,
    Headline,
    LearningCurve,
    RegressionPlot,
    ReportContent,
    ShapeScores,
    mean_curve,
)
from regress.runtime.model import Model
from regress.targets import VISIBLE_SHAPES


def content_of(model: Model) -> ReportContent:
    """Read everything a report says from a model.

    Raises
    ------
    ModelError
        The model was not trained by ``regress train``, so its record lacks the figures.
    """
    record = model.record
    try:
        scores = tuple(
            _scores(record["scores"][output], output, network.region)
            for network in model.table
            for output in network.outputs
        )
        curves = tuple(_curve(network.key, record["networks"][network.key]) for network in model.table)
        # records of older models do not say; theirs were split by person as a rule
        known = record["dataset"].get("people_in_training", {}).get("test", 0)
        unseen = "sessions" if known else "people"
        return ReportContent(
            title=f"Model report: {model.recipe} recipe",
            summary=_summary(model, known),
            unseen=unseen,
            people_in_training=known,
            headlines=_headlines(scores, unseen),
            scores=scores,
            constant=tuple(name for name in BLENDSHAPES if name not in model.outputs),
            curve=mean_curve(curves),
            curves=curves,
            noisy_training=record["recipe"]["noise"] is not None,
            floor=record["summary"].get("ridge_same_rows", {}).get("mean_r2_visible"),
            regressions=tuple(_regression(split, record["regression"][split]) for split in SPLITS),
            calibration=_calibration(record),
            provenance=_provenance(model),
        )
    except KeyError as error:
        raise ModelError(
            f"the model's record has no {error}: a report needs the figures that `regress train` writes into "
            f"model.json"
        ) from error


def _scores(record: dict[str, Any], name: str, region: str) -> ShapeScores:
    methods = {
        method: Figures(**{figure: _number(record[method][figure]) for figure in ("r2", "mae", "pearson")})
        for method in ("network", "ridge", "mean")
    }
    return ShapeScores(name=name, region=region, **methods)


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def _curve(name: str, record: dict[str, Any]) -> LearningCurve:
    series = {split: np.array(record["curves"][split], dtype=float) for split in SPLITS}
    return LearningCurve(name=name, best_step=record["best_step"], **series)


def _regression(split: str, record: dict[str, Any]) -> RegressionPlot:
    return RegressionPlot(
        split=split,
        counts=np.array(record["counts"]),
        slope=_number(record["slope"]),
        intercept=_number(record["intercept"]),
        pearson=_number(record["pearson"]),
    )


def _summary(model: Model, known: int) -> str:
    dataset = model.record["dataset"]
    samples = dataset["samples"]
    whose = f"sessions they have never seen, though of {known:,} people whom they have" if known else ""
    return (
        f"{len(model.table)} networks turn 68 facial landmarks into {len(model.outputs)} avatar weights. "
        f"Trained on {samples['train']:,} synthetic faces, judged on {samples['test']:,} faces of "
        f"{whose or 'people they have never seen'}."
    )


def _headlines(scores: tuple[ShapeScores, ...], unseen: str) -> tuple[Headline, ...]:
    visible = [score for score in scores if score.name in VISIBLE_SHAPES]

    def mean(method: str, figure: str, among=visible) -> float:
        values = np.array([getattr(getattr(score, method), figure) for score in among])
        return float(values[np.isfinite(values)].mean()) if np.isfinite(values).any() else math.nan

    r2, ridge, all_r2, all_ridge = (
        f"{mean(method, 'r2', among):.3f}" for among in (visible, scores) for method in ("network", "ridge")
    )
    mae, mean_mae = f"{mean('network', 'mae'):.3f}", f"{mean('mean', 'mae'):.3f}"
    seen = sum(score.grade == "seen" for score in scores)
    return (
        Headline(value=r2, caption=f"mean R² of the {len(visible)} visible shapes; ridge regression {ridge}"),
        Headline(value=all_r2, caption=f"mean R² of all {len(scores)} shapes; ridge regression {all_ridge}"),
        Headline(
            value=mae, caption=f"mean absolute error of a visible shape's weight; always the mean {mean_mae}"
        ),
        Headline(value=f"{seen} of {len(scores)}", caption=f"shapes reach R² {SEEN_R2} on unseen {unseen}"),
    )


def _calibration(record: dict[str, Any]) -> tuple[CalibrationRow, ...]:
    if "calibrated" not in record["summary"]:
        return ()
    return tuple(
        CalibrationRow(
            landmarks=landmarks,
            shapes=shapes,
            alone=_number(figures["network"][key]),
            calibrated=_number(figures["calibrated"][key]),
        )
        for landmarks, figures in (
            ("as in the dataset", record["summary"]),
            ("as a detector puts them", record["as_detected"]),
        )
        for shapes, key in (("visible shapes", "mean_r2_visible"), ("all shapes", "mean_r2"))
    )


def _provenance(model: Model) -> tuple[tuple[str, str], ...]:
    record, dataset = model.record, model.record["dataset"]
    samples = ", ".join(f"{count:,} {split}" for split, count in dataset["samples"].items())
    recipe = ", ".join(
        f"{key.replace('_', ' ')} {_said(value)}" for key, value in record["recipe"].items() if key != "name"
    )
    return (
        ("dataset", f"{dataset['name']} ({samples}; {dataset['people']:,} people)"),
        ("spec hash", _said(dataset["spec_hash"])),
        ("keypoints SHA-256", dataset["keypoints_sha256"]),
        *_rig(dataset["rig"]),
        ("licence of the data", _said(dataset["licence"])),
        ("licence of the model", record["licence"]),
        ("recipe", f"{model.recipe}: {recipe}"),
        ("training rows", f"{record['training_rows']:,}"),
        ("edges", f"{len(model.features.edges)}, from {model.features.reference_name}"),
        ("edges SHA-256", model.features.reference_sha256),
        ("seed", str(record["seed"])),
        ("ways networks ended", _outcomes(record["networks"])),
        ("versions", ", ".join(f"{name} {version}" for name, version in record["versions"].items())),
    )


def _rig(rig: Any) -> tuple[tuple[str, str], ...]:
    """A row for each thing a dataset says of its rig: attribution is among them."""
    if isinstance(rig, dict):
        return tuple((f"rig {key.replace('_', ' ')}", _said(value)) for key, value in rig.items())
    return (("rig", _said(rig)),)


def _outcomes(networks: dict[str, Any]) -> str:
    outcomes = [network["outcome"] for network in networks.values()]
    return ", ".join(
        f"{outcomes.count(outcome)} {outcome.lower().replace('_', ' ')}" for outcome in sorted(set(outcomes))
    )


def _said(value: Any) -> str:
    """A value of the record in words."""
    if value is None:
        return "not stated"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        return " ".join(f"{key} {_said(entry)}" for key, entry in value.items())
    if isinstance(value, list | tuple):
        return " / ".join(map(_said, value))
    return str(value)
