"""What `regress predict` does with lines of landmarks on a pipe: each is answered as it comes."""

import dataclasses
import itertools
import sys
from collections.abc import Iterable, Iterator

import numpy as np

from facegen.console import say
from regress.cli.fault_runs import FaultRuns
from regress.cli.landmark_take import FILM_FPS, head_settings
from regress.cli.neutral_faces import SHARES, in_pixels, neutral_file, refuse_other_units
from regress.errors import InputError
from regress.runtime.heads.camera import CameraSettings
from regress.runtime.inputs import Frames, face_faults, read_lines, text_lines
from regress.runtime.inputs.frames import are_shares, pixels_of
from regress.runtime.model import Model
from regress.runtime.predict import predict_stream
from regress.runtime.sample import Sample
from regress.runtime.stages.filters import DEFAULT_FILTER
from regress.runtime.stages.output import Output
from regress.runtime.writers.csv_table import csv_lines


def predict_pipe(
    model: Model,
    neutral: str,
    output: Output,
    *,
    camera: CameraSettings | None,
    keep_guessed_gaze: bool,
    auto_filter: bool,
    fps: float | None,
    strict: bool,
) -> None:
    """Predict lines of standard input, each as it comes, and write rows to standard output."""
    calm = None
    picture_px = None if camera is None else camera.picture_px
    samples = _in_pixels(read_lines(text_lines(sys.stdin), fps=fps), picture_px)
    if neutral == "first":
        waiting, calm = _up_to_a_face(samples)
        samples = itertools.chain(waiting, samples)
    elif neutral not in ("auto", "none"):
        calm = in_pixels(neutral_file(neutral, "standard input"), picture_px)
    if calm is not None:
        model = model.calibrate(calm.points)
    head = head_settings(camera, calm)
    first = list(itertools.islice(samples, 1))
    slowest, quickest = FILM_FPS
    if auto_filter and first and first[0].time_s is not None and slowest <= (fps or slowest) <= quickest:
        output = dataclasses.replace(output, filter=DEFAULT_FILTER)
    answers = predict_stream(
        itertools.chain(first, samples),
        model,
        output,
        head=head,
        keep_guessed_gaze=keep_guessed_gaze,
        auto=neutral == "auto",
        say=say,
    )
    for line in csv_lines(_told(answers, strict=strict), output.names):
        sys.stdout.write(line)
        sys.stdout.flush()  # the reader wants each frame as it comes


def _up_to_a_face(samples: Iterator[Sample]) -> tuple[list[Sample], Frames | None]:
    """The samples up to the first with a sound face, and this one alone; None where there is no such one."""
    waiting = []
    for sample in samples:
        waiting.append(sample)
        if face_faults(sample.points[None]) == [None]:
            irises = None if sample.irises is None else sample.irises[None]
            face = Frames(
                points=sample.points[None],
                labels=(sample.label,),
                time_s=None,
                source="standard input",
                irises=irises,
            )
            return waiting, face
    return waiting, None


def _in_pixels(samples: Iterable[Sample], picture_px: tuple[int, int] | None) -> Iterator[Sample]:
    """The samples with points in pixels; where no picture is known of shares, a person is told once."""
    shares = None
    for sample in samples:
        if shares is None and face_faults(sample.points[None]) == [None]:
            shares = are_shares(sample.points)  # the first face decides for all
            if shares and picture_px is None:
                say(f"standard input: {SHARES}")
            if not shares and picture_px is not None:
                refuse_other_units(float(np.ptp(sample.points, axis=0).max()), "standard input")
        if shares and picture_px is not None:
            irises = None if sample.irises is None else pixels_of(sample.irises, picture_px)
            sample = dataclasses.replace(sample, points=pixels_of(sample.points, picture_px), irises=irises)
        yield sample


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
