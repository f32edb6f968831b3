"""``regress headset temporal``: what a network gains from the frames before."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import say
from regress.errors import InputError

_COLUMNS = {"geometry_mm": "mm", "r2": "R2", "blink_r2": "blink R2", "gaze_deg": "gaze deg", "shake": "shake"}


def temporal(
    model: Annotated[Path, typer.Argument(help="Model folder of `regress headset train`.")],
    clips: Annotated[
        Path, typer.Argument(help="Arrays of clips (`facegen pack --format arrays`), unseen people.")
    ],
) -> None:
    """Find how much the four frames before each should count, and keep it in the model for `predict --temporal`.

    Taps are chosen on the clips' training people and judged on their test people; the network stays as it is. Shake is
    how far the error of a weight moves from frame to frame. Example: regress headset temporal models/headset
    datasets/out/headset-clips-arrays
    """
    from regress.learning.headset.arrays import read_arrays
    from regress.learning.headset.taps import fit_temporal
    from regress.runtime.headset.network.folder import describe_headset_model
    from regress.runtime.headset.network.predictor import load_headset_predictor
    from regress.runtime.ready_made import model_folder, ready_made_models

    folder = model_folder(model)
    if folder in ready_made_models().values():
        raise InputError(
            f"{model} comes with the package, which is not written into; copy {folder} and name the copy"
        )
    predictor, arrays = load_headset_predictor(folder), read_arrays(clips)
    found = fit_temporal(predictor, arrays)
    worn = arrays.description["headset"]
    if worn != predictor.model.headset:
        say(f"the clips are of the headset {worn}, and the model's is {predictor.model.headset}")
    describe_headset_model(replace(predictor.model, temporal=found), folder)
    typer.echo(f"{'':<14} " + " ".join(f"{title:>9}" for title in _COLUMNS.values()))
    for name, figures in found.scores.items():
        values = (getattr(figures, column) for column in _COLUMNS)
        cells = ("-" if value is None else f"{value:.4f}" for value in values)
        typer.echo(f"{name:<14} " + " ".join(f"{cell:>9}" for cell in cells))
    alone, together = (found.scores[name].geometry_mm for name in ("one frame", "taps"))
    if together > alone:
        say(
            f"with the taps these people's faces err by {together:.4f} mm, and by {alone:.4f} mm without: --temporal "
            f"makes predictions no better here; clips of more people may"
        )
    typer.echo(f"taps for {found.fps:.0f} frames a second in {model}")
