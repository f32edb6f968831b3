"""A CSV of weights: ``frame``, ``time_s`` where known, a column a shape, and the gaze in degrees where there is one."""

import csv
import io
from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.runtime.prediction import Prediction
from regress.runtime.sample import Sample

GAZE_COLUMNS = ("left_eye_yaw_deg", "left_eye_pitch_deg", "right_eye_yaw_deg", "right_eye_pitch_deg")
"""Behind the weights: yaw to the subject's left, pitch upwards, in the head frame."""


def csv_lines(samples: Iterable[Sample], names: tuple[str, ...]) -> Iterator[str]:
    """Lines of the table, each as soon as its frame is known; the first frame says which columns there are.

    Cells of a frame stay empty where nothing could be said.
    """
    for number, sample in enumerate(samples):
        timed = sample.time_s is not None
        if number == 0:
            gaze_columns = () if sample.gaze is None else GAZE_COLUMNS
            yield _line(["frame", *(["time_s"] if timed else []), *names, *gaze_columns])
        values = sample.weights
        if sample.gaze is not None:
            values = np.concatenate([values, np.degrees(sample.gaze)])
        empty = np.isnan(values).any()
        time_cell = ["" if np.isnan(sample.time_s) else f"{sample.time_s:.6f}"] if timed else []
        yield _line([sample.label, *time_cell, *("" if empty else f"{value:.6f}" for value in values)])


def weights_csv(prediction: Prediction) -> str:
    """The whole table of a take."""
    return "".join(csv_lines(prediction.samples, prediction.names))


def confidence_csv(prediction: Prediction) -> str:
    """A table of the same rows with the trust in each ARKit weight."""
    rows = (replace(sample, weights=sample.confidence, gaze=None) for sample in prediction.samples)
    return "".join(csv_lines(rows, BLENDSHAPES))


def _line(cells: list[str]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(cells)
    return buffer.getvalue()
