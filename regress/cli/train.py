"""``regress train``: from a dataset to a model."""

import time
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import counted, progress, say
from regress.errors import InputError


def train(
    dataset: Annotated[Path, typer.Argument(help="Folder that `facegen generate` made.")],
    out: Annotated[
        Path, typer.Option("--out", help="Model folder to write; an older model of this kind is replaced.")
    ],
    recipe: Annotated[
        str, typer.Option("--recipe", help="How to train: default, exact, paper or another of RECIPES.")
    ] = "default",
    detector: Annotated[
        str | None,
        typer.Option(
            "--detector", help="Learn from points as this detector puts them: mediapipe. Without, as any may."
        ),
    ] = None,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the networks' starts.")] = 0,
) -> None:
    """Train the 31 networks on a dataset's keypoints and compare them with ridge regression and the mean.

    Example: regress train datasets/out/default --out models/default
    """
    from regress.learning.training import RECIPES, for_detector, read_dataset
    from regress.learning.training import train as train_model
    from regress.model_card import heads_in_words
    from regress.runtime.model import KEYPOINTS, check_place, save_model

    if recipe not in RECIPES:
        raise InputError(f"--recipe is {recipe!r}, but must be one of {', '.join(RECIPES)}")
    chosen = RECIPES[recipe] if detector is None else for_detector(RECIPES[recipe], detector)
    keypoints = read_dataset(dataset)
    check_place(out, KEYPOINTS)
    began = time.monotonic()
    with progress(unit="%") as draw:
        model = train_model(keypoints, chosen, seed=seed, progress=draw)
    save_model(model, out, data=dataset)
    say(
        f"trained on {counted(model.record.training_rows, 'row')} in {time.monotonic() - began:.0f} s; model in {out}"
    )
    say(f"the heads came from {heads_in_words(model.record.dataset.rig)}")
    if in_training := model.record.dataset.people_in_training.get("test", 0):
        say(
            f"of the test split's people {in_training:,} are in training too: figures are not of unseen people"
        )
    for name, figures in model.record.summary.items():
        r2, visible = figures.mean_r2_networks, figures.mean_r2_visible
        say(f"{name.replace('_', ' '):>26}: test R2 {_figure(r2)}, visible shapes {_figure(visible)}")


def _figure(value: float | None) -> str:
    return "undefined" if value is None else f"{value:.3f}"
