"""``regress headset compass``: from arrays of drawn headsets to the network that tells how eyes lie in pictures."""

import importlib
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import counted, progress, say


def compass(
    arrays: Annotated[
        Path, typer.Argument(help="Folder that `facegen pack --format arrays` made, of drawn headsets.")
    ],
    out: Annotated[Path, typer.Option("--out", help="Graph (.onnx) to write.")],
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the start, order and views.")] = 0,
    epochs: Annotated[
        int, typer.Option("--epochs", min=1, help="Passes over the pictures, each member's.")
    ] = 45,
    members: Annotated[int, typer.Option("--members", min=1, help="Networks that are averaged.")] = 2,
) -> None:
    """Train the network by which `check` tells eyes upright from turned ones, and from those in a mirror.

    The package ships one. It learns from eyes of drawn headsets in all eight orientations, lit anew each time; a
    second run goes on where the first was stopped.

    Example: regress headset compass datasets/out/headset-any-arrays --out eye_compass.onnx
    """
    from facegen.files import refuse_ending

    refuse_ending(out, ".onnx", what="a graph")
    importlib.import_module("torch")  # first, so that its extra is named: it brings what the others need
    from regress.learning.headset.arrays import read_arrays
    from regress.learning.headset.compass import train_compass

    with progress(unit="epochs") as draw:
        scores = train_compass(
            read_arrays(arrays),
            out,
            seed=seed,
            epochs=epochs,
            members=members,
            progress=lambda stage, *steps: draw(f"{out.name}: {stage}", *steps),
        )
    if scores.views:
        say(
            f"of {counted(scores.views, 'single view')} of unseen people it tells {scores.orientation:.0%} right, the "
            f"side of {scores.side:.0%} and the quarter of {scores.quarter:.0%}"
        )
    say(f"compass in {out}")
