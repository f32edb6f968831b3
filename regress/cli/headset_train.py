"""``regress headset train``: from arrays of pictures to a model."""

import importlib
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Literal

import typer

from facegen.console import counted, progress, say
from regress.errors import InputError
from regress.learning.headset.architectures import ARCHITECTURES
from regress.learning.headset.recipe import DRAWN_SETTINGS, WITHHOLDINGS, HeadsetRecipe, recipe_of, sizes_of

_PLAIN = HeadsetRecipe()


def train(
    arrays: Annotated[Path, typer.Argument(help="Folder that `facegen pack --format arrays` made.")],
    out: Annotated[
        Path, typer.Option("--out", help="Model folder to write; an older model of this kind is replaced.")
    ],
    architecture: Annotated[
        Literal[tuple(ARCHITECTURES)] | None,
        typer.Option(
            "--architecture",
            help="; ".join(f"{name}: {one.help}" for name, one in ARCHITECTURES.items())
            + f". That of --start; {_PLAIN.architecture} without.",
        ),
    ] = None,
    seed: Annotated[
        int, typer.Option("--seed", min=0, help="Seed of the start, order and changes of pictures.")
    ] = 0,
    epochs: Annotated[int, typer.Option("--epochs", min=1, help="Passes over the frames.")] = _PLAIN.epochs,
    calibration: Annotated[
        bool,
        typer.Option("--calibration/--no-calibration", help="Whether neutral pictures are a second input."),
    ] = True,
    modulation: Annotated[
        float, typer.Option("--modulation", help="Factor on a camera's say outside its part; 0 is none.")
    ] = _PLAIN.modulation,
    part_loss: Annotated[
        float, typer.Option("--part-loss", help="Weight of each camera's own error on its part.")
    ] = _PLAIN.part_loss,
    camera_dropout: Annotated[
        float, typer.Option("--camera-dropout", help="Share of frames that a camera is absent from.")
    ] = _PLAIN.camera_dropout,
    randomise: Annotated[
        float,
        typer.Option(
            "--randomise", help="Strength of photometric randomisation, for real cameras; 0 leaves it out."
        ),
    ] = _PLAIN.randomise,
    withhold: Annotated[
        Literal[WITHHOLDINGS],
        typer.Option("--withhold", help="Frames to train without, to see what is learned from others."),
    ] = "none",
    people: Annotated[
        int, typer.Option("--people", min=0, help="Train on the first so many people; 0 is all.")
    ] = 0,
    start: Annotated[
        Path | None,
        typer.Option(
            "--start",
            metavar="MODEL",
            help="Go on from a trained model, or a ready-made one by its name; the network has its sizes.",
        ),
    ] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="NAME=VALUE",
            help="Any other setting of regress/learning/headset/recipe.py, as learning_rate=1e-3.",
        ),
    ] = None,
) -> None:
    """Train a network on pictures with exact labels, on one core; a second run goes on where the first was stopped.

    Half of the pictures are displaced and lit as in other cameras, for real ones are. Where each person of the arrays
    wears another, drawn headset, the network is told of the cameras.

    Example: regress headset train datasets/out/headset-arrays --out models/headset
    """
    chosen = _settings(
        {
            "architecture": architecture,
            "seed": seed,
            "epochs": epochs,
            "calibration": calibration,
            "modulation": modulation,
            "part_loss": part_loss,
            "camera_dropout": camera_dropout,
            "randomise": randomise,
            "withhold": withhold,
            "people": people,
        },
        settings or [],
    )
    importlib.import_module("torch")  # first, so that its extra is named: it brings what the others need
    from regress.learning.headset.arrays import read_arrays
    from regress.learning.headset.training import train_headset
    from regress.runtime.headset.network.folder import read_headset_model
    from regress.runtime.ready_made import model_folder

    frames = read_arrays(arrays)
    started = None if start is None else model_folder(start)
    begun = {} if started is None else sizes_of(read_headset_model(started).training.recipe)
    recipe = recipe_of({**begun, **(DRAWN_SETTINGS if frames.drawn else {}), **chosen})
    for note in side_notes(tuple(camera.name for camera in frames.cameras)):
        say(note)
    began = time.monotonic()
    with progress(unit="steps") as draw:
        model = train_headset(
            frames,
            recipe,
            out,
            start=started,
            progress=lambda stage, *steps: draw(f"{out.name}: {stage}", *steps),
        )
    record = model.training
    rows, people = counted(record.rows, "frame"), counted(record.people, "person", "people")
    say(f"trained on {rows} of {people} in {time.monotonic() - began:.0f} s")
    for name, figures in (model.scores.conditions if model.scores else {}).items():
        if name.removesuffix("_told") in ("uncalibrated", "same_seat"):
            r2 = "undefined" if figures.r2 is None else f"{figures.r2:.3f}"
            said = name.replace("_", " ")
            say(f"{said:>17}: {figures.geometry_mm:.3f} mm, R2 {r2}, gaze {figures.gaze_deg:.2f} degrees")
    say(f"model in {out}")


def side_notes(cameras: tuple[str, ...]) -> list[str]:
    """What names of cameras leave open, a sentence; nothing where they say all."""
    from regress.runtime.headset.network.parts import without_side

    lost = without_side(cameras)
    if not lost:
        return []
    return [
        f"{', '.join(lost)}: the name says neither left nor right, so it shares no other's network and no faces in a "
        f"mirror are learned from; call cameras left_eye and right_eye, or one of both eyes"
    ]


def _settings(chosen: dict[str, object], pairs: Sequence[str]) -> dict[str, object]:
    """The settings of the options and of ``NAME=VALUE`` pairs, checked; others are left out."""
    others = [name for name in _PLAIN.settings() if name not in chosen]
    for pair in pairs:
        name, sign, text = pair.partition("=")
        if not sign or name not in others:
            raise InputError(f"--set {pair!r} is not NAME=VALUE with one of {', '.join(others)}")
        chosen[name] = text
    said = {name: value for name, value in chosen.items() if value is not None}
    recipe_of(said)
    return said
