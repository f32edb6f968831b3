"""``regress report``: what a model can do, as one page."""

import json
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import say
from facegen.files import refuse_ending, refuse_sources, write_whole
from regress.errors import InputError


def report(
    model: Annotated[Path, typer.Argument(help="Model folder, as `regress train` writes it")],
    out: Annotated[Path, typer.Option(help="HTML file to write")] = Path("report.html"),
    data: Annotated[
        Path | None,
        typer.Option(
            help="Dataset that the model was trained on: measures noise, pose, leaks and people, in a minute."
        ),
    ] = None,
    figures: Annotated[
        Path | None, typer.Option(help="JSON file for what --data measures, unrounded.")
    ] = None,
) -> None:
    """Write one HTML file with every figure of a model: it opens without a network.

    Example: regress report models/default --data datasets/out/default --out report.html
    """
    from regress.learning.probes import figures_of, measure
    from regress.report import write_report
    from regress.runtime.model import load_model
    from regress.runtime.ready_made import model_folder

    if figures is not None and data is None:
        raise InputError(
            "--figures has nothing to write without a dataset to measure on; give --data as well"
        )
    refuse_ending(out, ".html", ".htm", what="a report")
    if figures is not None:
        refuse_ending(figures, ".json", what="a file of figures", option="--figures")
    trained = load_model(model)
    folder = model_folder(model)
    sources = [
        folder / "model.json",
        folder / "weights.npz",
        *([] if data is None else [data / "dataset.json"]),
    ]
    refuse_sources(out, sources)
    if figures is not None:
        refuse_sources(figures, sources, option="--figures")
    measured = None if data is None else measure(trained, data)
    typer.echo(write_report(trained, out, measured))
    if figures is not None:
        write_whole(figures, json.dumps(figures_of(measured), indent=1, allow_nan=False) + "\n")
        say(f"figures in {figures}")
