"""``regress predict``: landmarks in, a table of weights out."""

import os
import sys
import tempfile
from pathlib import Path
from typing import Annotated

import typer

from regress.cli.talk import say
from regress.errors import InputError, OutputError
from regress.inputs import read_frames
from regress.model import load_model
from regress.predict import predict_frames, prediction_csv


def predict(
    model: Annotated[Path, typer.Argument(help="Model folder.")],
    landmarks: Annotated[
        Path,
        typer.Argument(
            metavar="INPUT",
            help="A .pts file or a folder of them, .npy (n, 68, 2), OpenFace or py-feat .csv.",
        ),
    ],
    out: Annotated[
        Path | None, typer.Option("--out", help="CSV file to write; standard output without.")
    ] = None,
    strict: Annotated[bool, typer.Option("--strict", help="Fail where any frame has no face.")] = False,
    smooth: Annotated[int, typer.Option("--smooth", min=1, help="Frames of a moving average over time.")] = 1,
) -> None:
    """Predict the 52 blendshape weights of every frame.

    A frame without a face gets empty cells.

    Example: regress predict models/default take.csv --out weights.csv
    """
    loaded = load_model(model)
    frames = read_frames(landmarks)
    prediction = predict_frames(loaded, frames, smooth=smooth)
    empty = prediction.empty_rows
    if empty:
        found = f"{len(empty)} of {len(frames.labels)} rows have no face: {_numbers(empty)}"
        if strict:
            raise InputError(f"{frames.source}: {found}; without --strict their cells stay empty")
        say(f"{frames.source}: {found}")
    text = prediction_csv(prediction)
    if out is None:
        sys.stdout.write(text)
        sys.stdout.flush()
    else:
        _write(out, text)


def _numbers(rows: list[int]) -> str:
    """Row numbers with runs joined: ``3, 7-9``."""
    runs: list[list[int]] = []
    for row in rows:
        if runs and row == runs[-1][1] + 1:
            runs[-1][1] = row
        else:
            runs.append([row, row])
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def _write(path: Path, text: str) -> None:
    """Write to a temporary file beside it, then rename: a file that exists is complete."""
    try:
        with tempfile.NamedTemporaryFile(
            "w", dir=path.absolute().parent, prefix=f".{path.name}-", delete=False, encoding="utf-8"
        ) as file:
            try:
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
                os.chmod(file.name, 0o644)
                os.replace(file.name, path)
            except BaseException:
                os.unlink(file.name)
                raise
    except OSError as error:
        raise OutputError(f"{path} cannot be written: {error.strerror or error}") from error
