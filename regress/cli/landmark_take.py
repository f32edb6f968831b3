"""What `regress predict` does with a recording of landmarks."""

import dataclasses
from pathlib import Path

import numpy as np

from facegen.console import say
from facegen.files import write_whole
from regress.cli.neutral_faces import in_pixels, neutral_faces
from regress.cli.options import TableFormat
from regress.cli.results import needs_times, write_prediction
from regress.cli.rows import sound_rows
from regress.errors import InputError
from regress.runtime.heads.camera import CameraSettings
from regress.runtime.inputs import Frames, read_frames
from regress.runtime.inputs.times import IN_ORDER
from regress.runtime.model import Model
from regress.runtime.predict import predict_frames
from regress.runtime.ready_made import LANDMARKS
from regress.runtime.sample import Sample
from regress.runtime.stages.filters import FILM_FILTER
from regress.runtime.stages.head import HeadSettings
from regress.runtime.stages.output import Output
from regress.runtime.writers.csv_table import confidence_csv

FILM_FPS = (5.0, 500.0)
"""Frames a second of what is filtered unasked. Rows of stills have no times, equal ones, or count milliseconds."""

FEWEST_OF_FILM = 10
"""Frames without times that may be a film's."""

STEADY = 0.1
"""Of a face's width: films' faces move by less from most frames to the next, those of photographs by more."""


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


def predict_file(
    model: Model,
    landmarks: Path,
    output: Output,
    *,
    neutral: str | None,
    auto_filter: bool,
    auto_blinks: bool,
    fps: float | None,
    strict: bool,
    trust: Path | None,
    camera: CameraSettings | None,
    keep_guessed_gaze: bool,
    table_format: TableFormat,
    gltf: Path | None,
    out: Path | None,
) -> None:
    """Predict a recording and write what was asked for; the arguments are the command's options."""
    frames = read_frames(landmarks)
    if fps is not None:
        frames = frames.at_rate(fps)
    if camera is not None and camera.picture_px is not None:
        frames = dataclasses.replace(frames, picture_px=camera.picture_px)
    elif camera is not None and camera.focal_px is None:
        camera = dataclasses.replace(camera, picture_px=frames.picture_px)
    frames = in_pixels(frames, frames.picture_px)
    takes = frames.takes()
    main = frames.take(max(takes.values(), key=len))  # a passer-by's rows say nothing of a film's rate
    if len(takes) > 1 and needs_times(table_format, gltf):
        say(
            f"{landmarks}: there are several {frames.kind_of_takes}s, and an animation or a recording is of one: "
            f"{frames.kind_of_takes} {main.faces[0]} is written, with {len(main.labels)} of {len(frames.labels)} rows"
        )
        frames, takes = main, main.takes()
    if auto_filter and is_film(main.time_s):
        output = dataclasses.replace(output, filter=FILM_FILTER)
    elif auto_filter and main.time_s is main.odd_times is None and is_steady(main.points):
        say(
            f"{landmarks}: no times are given, so weights are not filtered; if this is a film, --fps says how many "
            "frames a second it has"
        )
    if fps is None:
        _say_odd_rate(str(landmarks), main)
    timed = output.needs_times or needs_times(table_format, gltf)
    frames = sound_rows(frames, needs_times=timed, strict=strict)
    # without a neutral face a lid's readings mean less: there stretched ones err more (docs/measurements)
    auto_blinks = auto_blinks and is_film(main.time_s)
    if neutral is None and len(frames.labels) > 1 and model.calibrated is not None:
        say(
            f"{landmarks}: no neutral face is given, so weights are guesses; --neutral names frames at rest, as in "
            f"{frames.labels[0]}, or looks for them by auto"
        )
    calm = neutral_faces(model, frames, neutral or "none")
    samples: list[Sample | None] = [None] * len(frames.labels)
    for face, rows in takes.items():
        prediction = predict_frames(
            model if calm[face] is None else model.calibrate(calm[face].points),
            frames.take(rows),
            output=output.with_own_blinks(film=auto_blinks and calm[face] is not None),
            confident=trust is not None,
            head=head_settings(camera, calm[face]),
            keep_guessed_gaze=keep_guessed_gaze,
            say=say,
        )
        for row, sample in zip(rows, prediction.samples, strict=True):
            samples[row] = sample
    prediction = dataclasses.replace(prediction, samples=samples)
    if trust is not None:
        write_whole(trust, confidence_csv(prediction))
    write_prediction(prediction, table_format, out=out, gltf=gltf)


def _say_odd_rate(source: str, take: Frames) -> None:
    """Tell of times that cannot be a camera's: none that go on, too many a second, or a film's of milliseconds."""
    column = "key" if take.source.lower().endswith(".json") else "column"
    if take.odd_times is not None and len(take.labels) > 1:
        say(
            f"{source}: the {column} {take.odd_times} does not go on from frame to frame, so there are no times; "
            "--fps says how many frames a second a film has"
        )
        return
    rate = frames_a_second(take.time_s)
    if rate > FILM_FPS[1]:
        say(f"{source}: its times are of {rate:.0f} frames a second; --fps says what the camera's were")
    elif 0 < rate < FILM_FPS[0] and is_steady(take.points):
        say(
            f"{source}: its times are of {rate:.2g} frames a second, which is no film, so weights are not filtered; if "
            f"they are milliseconds, call the {column} timestamp_ms, or give --fps"
        )
    elif take.time_s is not None and rate == 0 and is_steady(take.points):
        say(
            f"{source}: its times do not go on from frame to frame, so weights are not filtered; --fps says how many "
            "frames a second a film has"
        )


def is_film(time_s: np.ndarray | None) -> bool:
    """Whether frames at these times (n,) follow one another as a camera's do."""
    slowest, quickest = FILM_FPS
    if not slowest <= frames_a_second(time_s) <= quickest:
        return False
    return bool(np.mean(np.diff(time_s) > 0) >= IN_ORDER)


def is_steady(points: np.ndarray) -> bool:
    """Whether faces (n, 68, 2) stay where they are from frame to frame, as a film's do."""
    if len(points) < FEWEST_OF_FILM:
        return False
    moves = np.linalg.norm(np.diff(points.mean(axis=1), axis=0), axis=1) / np.ptp(points[:-1, :, 0], axis=1)
    return np.isfinite(moves).any() and bool(np.nanmedian(moves) < STEADY)


def frames_a_second(time_s: np.ndarray | None) -> float:
    """How many frames a second times (n,) are of, by their median distance; 0 where they do not say."""
    if time_s is None or len(time_s) < 2:
        return 0.0
    seconds = np.diff(time_s)
    if not np.isfinite(seconds).any():
        return 0.0
    middle = float(np.nanmedian(seconds))
    return 1 / middle if middle > 0 else 0.0


def head_settings(camera: CameraSettings | None, calm: Frames | None) -> HeadSettings:
    """Settings of the head: what is known of the head; without a camera its pose does not leave."""
    return HeadSettings(
        camera=camera or CameraSettings(),
        neutral=None if calm is None else calm.points,
        neutral_irises=None if calm is None else calm.irises,
        wanted=camera is not None,
    )
