"""``regress report``: what a model can do, as one page."""

from pathlib import Path
from typing import Annotated

import typer

from regress.model import load_model
from regress.report import write_report


def report(
    model: Annotated[Path, typer.Argument(help="Model folder, as `regress train` writes it")],
    out: Annotated[Path, typer.Option(help="HTML file to write")] = Path("report.html"),
) -> None:
    """Write one HTML file with every figure of a model: it opens without a network.

    Example: regress report models/default --out report.html
    """
    typer.echo(write_report(load_model(model), out))
