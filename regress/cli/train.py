"""``regress train``: from a dataset to a model."""

import time
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from regress.cli.talk import progress, say
from regress.learning.training import RECIPES, read_dataset
from regress.learning.training import train as train_model
from regress.runtime.model import KEYPOINTS, check_place, save_model

RecipeName = StrEnum("RecipeName", list(RECIPES))


def train(
    dataset: Annotated[Path, typer.Argument(help="Folder that `facegen generate` made.")],
    out: Annotated[
        Path, typer.Option("--out", help="Model folder to write; an older model of this kind is replaced.")
    ],
    recipe: Annotated[RecipeName, typer.Option("--recipe", help="How to train.")] = RecipeName.default,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the networks' starts.")] = 0,
) -> None:
    """Train the 31 networks on a dataset's keypoints and compare them with ridge regression and the mean.

    Example: regress train datasets/out/default --out models/default
    """
    keypoints = read_dataset(dataset)
    check_place(out, KEYPOINTS)
    began = time.monotonic()
    with progress() as draw:
        model = train_model(keypoints, RECIPES[recipe.value], seed=seed, progress=draw)
    save_model(model, out)
    say(
        f"trained on {model.record['training_rows']} rows in {time.monotonic() - began:.0f} s; model in {out}"
    )
    for name, figures in model.record["summary"].items():
        r2, visible = figures["mean_r2_networks"], figures["mean_r2_visible"]
        say(f"{name.replace('_', ' '):>26}: test R2 {_figure(r2)}, visible shapes {_figure(visible)}")


def _figure(value: float | None) -> str:
    return "undefined" if value is None else f"{value:.3f}"
