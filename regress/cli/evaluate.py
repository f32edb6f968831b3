"""``regress evaluate``: a model's figures on a dataset."""

import dataclasses
import json
from pathlib import Path
from typing import Annotated, Literal

import typer

from facegen.conventions import SPLITS

SplitOption = Annotated[Literal[SPLITS], typer.Option("--split", help="Whose faces to score.")]


def evaluate(
    model: Annotated[Path, typer.Argument(help="Model folder.")],
    dataset: Annotated[Path, typer.Argument(help="Folder that `facegen generate` made.")],
    split: SplitOption = "test",
    calibrated: Annotated[
        bool, typer.Option("--calibrated", help="Give the networks each person's neutral frame.")
    ] = False,
    detector: Annotated[
        str | None,
        typer.Option(
            "--detector", help="Displace points as this detector does, frame by frame too: mediapipe."
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Unrounded figures for programs.")] = False,
) -> None:
    """Print R2, mean absolute error and correlation of every shape on one split.

    Example: regress evaluate models/default datasets/out/default
    """
    from regress.learning.training import evaluate_model, read_dataset
    from regress.learning.training.detectors import detector_noise
    from regress.learning.training.scores import mean_r2
    from regress.runtime.model import load_model
    from regress.targets import OUTPUTS, VISIBLE_SHAPES, observability

    noise = None if detector is None else detector_noise(detector)
    loaded, keypoints = load_model(model), read_dataset(dataset, splits=(split,))
    scores = evaluate_model(loaded, keypoints, split=split, calibrated=calibrated, noise=noise)
    visible = tuple(name for name in VISIBLE_SHAPES if name in scores)
    summary = {
        "mean_r2": mean_r2(scores, tuple(scores)),
        "mean_r2_visible": mean_r2(scores, visible),
    }
    if as_json:
        shapes = {name: dataclasses.asdict(figures) for name, figures in scores.items()}
        document = {
            "split": split,
            "calibrated": calibrated,
            "detector": detector,
            "summary": summary,
            "scores": shapes,
        }
        typer.echo(json.dumps(document, allow_nan=False))
        return
    typer.echo(f"{'shape':<20} {'R2':>7} {'MAE':>7} {'r':>7}")
    for name in OUTPUTS:
        if name in scores:
            figures = scores[name]
            cells = " ".join(_cell(value) for value in (figures.r2, figures.mae, figures.pearson))
            typer.echo(f"{name:<20} {cells}  {observability(name)}")
    for name, value in summary.items():
        typer.echo(f"{name:<20} {_cell(value)}")


def _cell(value: float | None) -> str:
    return f"{'-':>7}" if value is None else f"{value:7.3f}"
