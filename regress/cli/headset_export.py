"""``regress headset export``: a network's graph, and what a program must know to run it."""

import json
from pathlib import Path
from typing import Annotated

import typer

from facegen.files import output_errors, refuse_sources, write_whole


def export(
    model: Annotated[Path, typer.Argument(help="Model folder of `regress headset train`.")],
    out: Annotated[Path, typer.Option("--out", help="Folder for the files.")] = Path(),
    name: Annotated[str, typer.Option("--name", help="What the files are called.")] = "headset",
) -> None:
    """Write the ONNX graph, and a JSON with its cameras, inputs, outputs and shapes' names.

    Pictures go in as the cameras give them: the graph holds all that happens to them. Example: regress headset export
    models/headset --out exports
    """
    from regress.exporters.headset_interface import interface_of
    from regress.runtime.headset.network.predictor import load_headset_predictor
    from regress.runtime.ready_made import model_folder

    predictor = load_headset_predictor(model)
    folder = model_folder(model)
    graph = (folder / "network.onnx").read_bytes()
    text = json.dumps(interface_of(predictor.model, graph=f"{name}.onnx"), indent=1) + "\n"
    for ending in ("onnx", "json"):
        refuse_sources(
            out / f"{name}.{ending}", [folder / "network.onnx", folder / "model.json"], option="export"
        )
    with output_errors(out):
        out.mkdir(parents=True, exist_ok=True)
    paths = [write_whole(out / f"{name}.onnx", graph), write_whole(out / f"{name}.json", text)]
    for path in paths:
        typer.echo(f"{path} ({path.stat().st_size:,} bytes)")
