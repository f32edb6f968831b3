"""``regress predict``: landmarks in, a table of weights out."""

import dataclasses
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from facegen.console import say
from facegen.files import write_whole
from regress.cli.fault_runs import FaultRuns
from regress.cli.options import (
    AvatarOption,
    BetaOption,
    BlendOption,
    FormatOption,
    MirrorOption,
    ModelOption,
    OneEuroOption,
    OutOption,
    RetargetOption,
    SmoothOption,
    TrustOption,
)
from regress.cli.results import TableFormat, check_targets, needs_times, write_prediction
from regress.cli.rows import sound_rows
from regress.errors import InputError
from regress.runtime.inputs import Frames, read_frames, read_lines
from regress.runtime.model import Model, load_model, symmetrised
from regress.runtime.predict import predict_frames, predict_stream
from regress.runtime.ready_made import LANDMARKS
from regress.runtime.sample import Sample
from regress.runtime.stages import OneEuro, Output
from regress.runtime.stages.adjustment_file import read_adjustments
from regress.runtime.stages.neutral import estimate_neutral
from regress.runtime.stages.retargeting.target_file import read_retargeting
from regress.runtime.writers import confidence_csv, csv_lines


def predict(
    arguments: Annotated[
        list[Path],
        typer.Argument(
            metavar="[MODEL] INPUT",
            help="Landmarks: .pts files and folders, .npy, OpenFace or py-feat .csv, dlib .xml, COCO .json, "
            "CK+ folders, or - for lines of 136 numbers on standard input. Before them the model, as --model takes it.",
        ),
    ],
    chosen: ModelOption = None,
    out: OutOption = None,
    table_format: FormatOption = TableFormat.csv,
    retarget: RetargetOption = None,
    gltf: AvatarOption = None,
    trust: TrustOption = None,
    neutral: Annotated[
        str,
        typer.Option(
            "--neutral",
            metavar="FRAME|FILE|auto|none",
            help="The person's neutral face: a frame of INPUT by its label, frames FIRST-LAST, another "
            "file of landmarks, or auto, which looks for it.",
        ),
    ] = "none",
    strict: Annotated[
        bool, typer.Option("--strict", help="Fail where a frame has no face, or none that can be right.")
    ] = False,
    smooth_landmarks_hz: Annotated[
        float | None,
        typer.Option(
            "--smooth-landmarks",
            metavar="HZ",
            min=1e-3,
            help="One-Euro smoothing of the landmarks themselves, with this cutoff at rest; try 1.",
        ),
    ] = None,
    smooth: SmoothOption = 1,
    cutoff_hz: OneEuroOption = None,
    beta: BetaOption = OneEuro.beta,
    fps: Annotated[
        float | None, typer.Option("--fps", min=1e-3, help="Frames a second; goes before times in INPUT.")
    ] = None,
    adjust: Annotated[
        Path | None,
        typer.Option("--adjust", help="JSON with gain, offset, dead_zone, low and high by shape."),
    ] = None,
    left_right_blend: BlendOption = 0.0,
    mirror: MirrorOption = False,
    symmetric: Annotated[
        bool,
        typer.Option(
            "--symmetric", help="Average every face's weights with its mirror image's; twice the time."
        ),
    ] = False,
) -> None:
    """Predict the 52 blendshape weights of every frame.

    A frame without a face gets empty cells, and so does one whose points are collapsed or mirrored or whose
    time is out of order; their row numbers are said. A neutral frame makes weights far better on real faces: it
    shows what the person is like, and where the detector puts its points.

    Example: regress predict take.csv --neutral 1 --one-euro 1 --out weights.csv
    """
    model, landmarks = model_and_input(arguments, chosen)
    loaded = symmetrised(load_model(model)) if symmetric else load_model(model)
    output = Output(
        smooth_landmarks_hz=smooth_landmarks_hz,
        smooth=smooth,
        one_euro=None if cutoff_hz is None else OneEuro(cutoff_hz=cutoff_hz, beta=beta),
        adjustments={} if adjust is None else read_adjustments(adjust),
        left_right_blend=left_right_blend,
        mirror=mirror,
        retargeting=None if retarget is None else read_retargeting(retarget),
    )
    check_targets(table_format, out=out, gltf=gltf, retargeted=retarget is not None)
    if str(landmarks) == "-":
        if not (out is gltf is trust is None and table_format is TableFormat.csv):
            raise InputError("weights of standard input leave as CSV on standard output alone: use > FILE")
        _predict_stream(loaded, neutral, output, fps=fps, strict=strict)
        return
    frames = read_frames(landmarks)
    if fps is not None:
        frames = dataclasses.replace(frames, time_s=np.arange(len(frames.labels)) / fps)
    timed = output.needs_times or needs_times(table_format, gltf)
    frames = sound_rows(frames, needs_times=timed, strict=strict)
    calibrated = _calibrated(loaded, frames, neutral)
    prediction = predict_frames(calibrated, frames, output=output, confident=trust is not None)
    if trust is not None:
        write_whole(trust, confidence_csv(prediction))
    write_prediction(prediction, table_format, out=out, gltf=gltf)


def model_and_input(arguments: list[Path], chosen: str | None) -> tuple[str | Path, Path]:
    """Which model sees which file: of two arguments the model comes first, one is the file.

    Raises
    ------
    InputError
        Where there are more, or the model is given twice.
    """
    *models, landmarks = arguments
    if len(models) + (chosen is not None) > 1:
        given = [str(model) for model in models] + ([f"--model {chosen}"] if chosen else [])
        raise InputError(
            f"one model and one INPUT are needed; before {landmarks} there are {', '.join(given)}"
        )
    return (models or [chosen or LANDMARKS])[0], landmarks


def _predict_stream(model: Model, neutral: str, output: Output, *, fps: float | None, strict: bool) -> None:
    if neutral not in ("auto", "none"):
        model = model.calibrate(_neutral_file(neutral, "standard input").points)
    samples = read_lines(sys.stdin, fps=fps)
    answers = predict_stream(samples, model, output, auto=neutral == "auto", say=say)
    try:
        for line in csv_lines(_told(answers, strict=strict), output.names):
            sys.stdout.write(line)
            sys.stdout.flush()  # the reader wants each frame as it comes
    except UnicodeDecodeError as error:
        raise InputError(
            f"standard input is not text ({error}); lines of 136 numbers are needed, and files are read by name"
        ) from error


def _told(answers: Iterable[Sample], *, strict: bool) -> Iterator[Sample]:
    """The answers, while runs of faulty lines are told; where ``strict``, the first one is an error."""
    runs, number = FaultRuns(say), 0
    for number, sample in enumerate(answers, start=1):
        fault = sample.faults.get("points")
        if fault is not None and strict:
            raise InputError(f"line {number} has {fault.value}; without --strict its cells stay empty")
        runs.step(number, fault)
        yield sample
    runs.step(number + 1, None)


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
    return sound_rows(read_frames(neutral))
