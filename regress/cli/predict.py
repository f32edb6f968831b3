"""``regress predict``: landmarks in, a table of weights out."""

import dataclasses
import os
import sys
import tempfile
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from regress.adjustment import read_adjustments
from regress.cli.talk import say
from regress.errors import InputError, OutputError
from regress.inputs import Frames, read_frames
from regress.model import Model, load_model
from regress.neutral import estimate_neutral
from regress.predict import Output, predict_frames, prediction_csv
from regress.smoothing import OneEuro
from regress.stream import stream_csv


def predict(
    model: Annotated[Path, typer.Argument(help="Model folder.")],
    landmarks: Annotated[
        Path,
        typer.Argument(
            metavar="INPUT",
            help="Landmarks: .pts files and folders, .npy, OpenFace or py-feat .csv, dlib .xml, COCO .json, "
            "CK+ folders, or - for lines of 136 numbers on standard input.",
        ),
    ],
    out: Annotated[
        Path | None, typer.Option("--out", help="CSV file to write; standard output without.")
    ] = None,
    neutral: Annotated[
        str,
        typer.Option(
            "--neutral",
            metavar="FRAME|FILE|auto|none",
            help="The person's neutral face: a frame of INPUT by its label, frames FIRST-LAST, another "
            "file of landmarks, or auto, which looks for it.",
        ),
    ] = "none",
    strict: Annotated[bool, typer.Option("--strict", help="Fail where any frame has no face.")] = False,
    smooth: Annotated[int, typer.Option("--smooth", min=1, help="Frames of a moving average over time.")] = 1,
    cutoff_hz: Annotated[
        float | None,
        typer.Option(
            "--one-euro", min=1e-3, help="One-Euro smoothing with this cutoff in Hz at rest; try 1."
        ),
    ] = None,
    beta: Annotated[
        float, typer.Option("--beta", min=0, help="One-Euro: Hz more for each unit of weight a second.")
    ] = OneEuro.beta,
    fps: Annotated[
        float | None, typer.Option("--fps", min=1e-3, help="Frames a second; goes before times in INPUT.")
    ] = None,
    adjust: Annotated[
        Path | None,
        typer.Option("--adjust", help="JSON with gain, offset, dead_zone, low and high by shape."),
    ] = None,
    left_right_blend: Annotated[
        float,
        typer.Option("--left-right-blend", min=0, max=1, help="0 leaves left and right, 1 averages them."),
    ] = 0.0,
    mirror: Annotated[bool, typer.Option("--mirror", help="Exchange left and right.")] = False,
) -> None:
    """Predict the 52 blendshape weights of every frame.

    A frame without a face gets empty cells. A neutral frame makes weights far better on real faces: it shows
    what the person is like, and where the detector puts its points.

    Example: regress predict models/default take.csv --neutral 1 --one-euro 1 --out weights.csv
    """
    loaded = load_model(model)
    output = Output(
        smooth=smooth,
        one_euro=None if cutoff_hz is None else OneEuro(cutoff_hz=cutoff_hz, beta=beta),
        adjustments={} if adjust is None else read_adjustments(adjust),
        left_right_blend=left_right_blend,
        mirror=mirror,
    )
    if str(landmarks) == "-":
        _predict_stream(loaded, neutral, output, fps, out)
        return
    frames = read_frames(landmarks)
    if fps is not None:
        frames = dataclasses.replace(frames, time_s=np.arange(len(frames.labels)) / fps)
    prediction = predict_frames(_calibrated(loaded, frames, neutral), frames, output=output)
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


def _predict_stream(model: Model, neutral: str, output: Output, fps: float | None, out: Path | None) -> None:
    if out is not None:
        raise InputError("weights of standard input go to standard output: leave out --out, and use > FILE")
    if neutral not in ("auto", "none"):
        model = model.calibrate(_neutral_file(neutral, "standard input").points)
    for line in stream_csv(sys.stdin, model, output, fps=fps, auto=neutral == "auto", say=say):
        sys.stdout.write(line)
        sys.stdout.flush()  # the reader wants each frame as it comes


def _calibrated(model: Model, frames: Frames, neutral: str) -> Model:
    """The model for this recording: calibrated where a neutral frame is named or found."""
    if neutral == "none":
        return model
    if neutral == "auto":
        estimate = estimate_neutral(model, frames.points)
        if not estimate.sure:
            say(f"{frames.source}: no neutral face found, weights are not calibrated: {estimate.reason}")
            return model
        say(f"{frames.source}: neutral face found: {estimate.reason}")
        return model.calibrate(frames.points[estimate.frames])
    named = _named(frames, neutral)
    return model.calibrate(frames.points[named] if named else _neutral_file(neutral, frames.source).points)


def _named(frames: Frames, neutral: str) -> list[int]:
    """Rows of a frame named by its label, or of frames FIRST-LAST."""
    first, _, last = neutral.rpartition("-")
    if neutral in frames.labels:
        first = last = neutral
    if first in frames.labels and last in frames.labels:
        start, stop = frames.labels.index(first), frames.labels.index(last)
        return list(range(start, stop + 1))
    return []


def _neutral_file(neutral: str, source: str) -> Frames:
    if not Path(neutral).exists():
        raise InputError(
            f"--neutral {neutral!r} is neither a frame of {source}, nor a file; auto and none are allowed too"
        )
    return read_frames(neutral)


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
