"""``regress export``: a trained model as a file that runs elsewhere."""

from enum import Enum
from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import say
from regress.errors import InputError
from regress.exporters import EXPORTERS

ExportFormat = Enum("ExportFormat", {name: name for name in ("all", *EXPORTERS)})


def export(
    model: Annotated[Path, typer.Argument(help="Model folder, as `regress train` writes it")],
    chosen: Annotated[
        list[ExportFormat],
        typer.Option("--format", help="What to write; may be given again; ONNX needs the learn extra"),
    ] = (ExportFormat["all"],),
    out: Annotated[Path, typer.Option(help="Folder for the files")] = Path(),
    name: Annotated[str, typer.Option(help="What the files, and C functions, are called")] = "face",
    neutral: Annotated[
        Path | None,
        typer.Option(help="Landmarks of a person's neutral face: the export is then calibrated to them"),
    ] = None,
    picture: Annotated[
        str | None,
        typer.Option(
            metavar="WIDTHxHEIGHT",
            help="Size in pixels of the picture of --neutral, where its points are shares of it between 0 and 1",
        ),
    ] = None,
    symmetric: Annotated[
        bool, typer.Option("--symmetric", help="Average every face with its mirror image; twice the size")
    ] = False,
) -> None:
    """Write a model for other programs: landmarks in, 52 weights out, alignment included.

    Every file agrees with `regress predict --filter none --no-own-blinks --keep-guessed-gaze` to 1e-4, but answers
    faces too which predict leaves out: in a mirror, with y upward, or on one line.

    Example: regress export models/default --format onnx
    """
    from regress.cli.camera import picture_size
    from regress.cli.neutral_faces import in_pixels
    from regress.cli.rows import sound_rows
    from regress.exporters import export_model
    from regress.runtime.inputs import read_frames
    from regress.runtime.model import load_model, symmetrised
    from regress.runtime.ready_made import model_folder

    loaded = symmetrised(load_model(model)) if symmetric else load_model(model)
    picture_px = None if picture is None else picture_size(picture)
    if neutral is not None:
        frames = read_frames(neutral)
        calm = in_pixels(frames, picture_px or frames.picture_px)
        loaded = loaded.calibrate(sound_rows(calm).points)
    elif picture is not None:
        raise InputError(f"--picture {picture} is the size of --neutral's picture; give --neutral as well")
    formats = _possible() if ExportFormat["all"] in chosen else [each.value for each in chosen]
    folder = model_folder(model)
    sources = [folder / "model.json", folder / "weights.npz", *([] if neutral is None else [neutral])]
    for path in export_model(loaded, out, name=name, formats=formats, sources=sources):
        typer.echo(f"{path} ({path.stat().st_size:,} bytes)")


def _possible() -> list[str]:
    """All formats, but ONNX's where its package is not installed."""
    if find_spec("onnx") is not None:
        return list(EXPORTERS)
    say("ONNX is left out, as it needs the learn extra: pip install 'facegen[learn]'")
    return [name for name, place in EXPORTERS.items() if not place.startswith("onnx_graph.")]
