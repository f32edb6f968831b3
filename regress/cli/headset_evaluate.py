"""``regress headset evaluate``: a model's figures on arrays."""

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from facegen.conventions import BLENDSHAPES
from regress.cli.evaluate import SplitOption

_COLUMNS = ("rows", "geometry_mm", "r2", "mae", "rmse", "blink_r2", "gaze_deg")


def evaluate(
    model: Annotated[Path, typer.Argument(help="Model folder of `regress headset train`.")],
    arrays: Annotated[Path, typer.Argument(help="Folder that `facegen pack --format arrays` made.")],
    split: SplitOption = "test",
    as_json: Annotated[bool, typer.Option("--json", help="Unrounded figures for programs.")] = False,
) -> None:
    """Print how well a model does against exact labels: calibrated or not, camera by camera, shape by shape.

    Example: regress headset evaluate models/headset datasets/out/headset-test-arrays
    """
    from facegen.console import say
    from regress.learning.headset.arrays import read_arrays
    from regress.learning.headset.evaluation import evaluate as evaluate_model
    from regress.runtime.headset.network.figures import evaluation_to_json
    from regress.runtime.headset.network.predictor import load_headset_predictor

    predictor = load_headset_predictor(model)
    evaluation = evaluate_model(predictor.graph, predictor.model, read_arrays(arrays), split=split)
    if as_json:
        typer.echo(json.dumps(evaluation_to_json(evaluation), allow_nan=False))
        return
    tables = {"ordinary frames": evaluation.conditions, "rare combinations": evaluation.combined}
    for title, conditions in tables.items():
        if conditions:
            typer.echo(f"{title:<24} " + " ".join(f"{name:>11}" for name in _COLUMNS))
            floors = evaluation.floors if conditions is evaluation.conditions else {}
            for name, figures in (*conditions.items(), *floors.items()):
                cells = (_cell(getattr(figures, column)) for column in _COLUMNS)
                typer.echo(f"{_said(name):<24} " + " ".join(cells))
            typer.echo("")
    if evaluation.few:
        say(evaluation.few)
    cameras, shapes = evaluation.cameras, evaluation.shapes
    calibrated = [name for name in ("uncalibrated", "same_seat") if name in shapes[BLENDSHAPES[0]]]
    typer.echo(f"{'R2':<20} " + " ".join(f"{_said(name):>16}" for name in (*calibrated, *cameras)))
    for shape in BLENDSHAPES:
        r2 = [shapes[shape][name].r2 for name in calibrated]
        r2 += [camera[shape] for camera in cameras.values()]
        typer.echo(f"{shape:<20} " + " ".join(f"{_cell(value):>16}" for value in r2))


def _said(name: str) -> str:
    return {"mean": "floor: training mean", "rest": "floor: resting face"}.get(name, name.replace("_", " "))


def _cell(value: Any) -> str:
    if value is None:
        return f"{'-':>11}"
    return f"{value:11d}" if isinstance(value, int) else f"{value:11.3f}"
