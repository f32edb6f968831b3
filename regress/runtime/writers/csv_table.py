"""A CSV of weights: ``frame``, ``time_s`` where known, a column a shape, gaze in degrees and head pose where known."""

import csv
import io
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.runtime.prediction import Prediction
from regress.runtime.sample import EyeMeasures, Sample

GAZE_COLUMNS = ("left_eye_yaw_deg", "left_eye_pitch_deg", "right_eye_yaw_deg", "right_eye_pitch_deg")
"""Behind the weights: yaw to the subject's left, pitch upwards, in the head frame."""


EYE_COLUMNS = (
    *("left_eye_openness_mm", "left_eye_openness", "left_eye_pupil"),
    *("right_eye_openness_mm", "right_eye_openness", "right_eye_pupil"),
)
"""Behind the head: distance of the lids, the same as a share of the person's own, and pupil over iris."""

HEAD_COLUMNS = (
    *("head_in_camera_x_m", "head_in_camera_y_m", "head_in_camera_z_m"),
    *("head_yaw_deg", "head_pitch_deg", "head_roll_deg"),
)
"""Behind the gaze: where the head's origin is in the camera frame (x right, y down, z forward), and its turn to the
subject's left, upwards, and towards the left shoulder."""


def csv_lines(samples: Iterable[Sample], names: tuple[str, ...]) -> Iterator[str]:
    """Lines of the table, each as soon as its frame is known; the first frame says which columns there are.

    Cells of a frame stay empty where nothing could be said.
    """
    for number, sample in enumerate(samples):
        timed = sample.time_s is not None
        gaze = () if sample.gaze is None else np.degrees(sample.gaze)
        if number == 0:
            gaze_columns = () if sample.gaze is None else GAZE_COLUMNS
            head_columns = () if sample.head is None else HEAD_COLUMNS
            eye_columns = () if sample.eyes is None else EYE_COLUMNS
            times = ["time_s"] if timed else []
            yield _line(["frame", *times, *names, *gaze_columns, *head_columns, *eye_columns])
        head = () if sample.head is None else (*sample.head[:3], *np.degrees(sample.head[3:]))
        time_cell = ["" if np.isnan(sample.time_s) else f"{sample.time_s:.6f}"] if timed else []
        eyes = () if sample.eyes is None else _eye_cells(sample.eyes)
        yield _line([sample.label, *time_cell, *_cells(sample.weights), *_cells(gaze), *_cells(head), *eyes])


def weights_csv(prediction: Prediction) -> str:
    """The whole table of a take."""
    return "".join(csv_lines(prediction.samples, prediction.names))


def confidence_csv(prediction: Prediction) -> str:
    """A table of the same rows with the trust in each ARKit weight."""
    rows = (replace(sample, weights=sample.confidence, gaze=None, head=None) for sample in prediction.samples)
    return "".join(csv_lines(rows, BLENDSHAPES))


def _cells(values: Sequence[float]) -> list[str]:
    """Numbers of a row, or as many empty cells where one of them is not known."""
    empty = np.isnan(values).any()
    return ["" if empty else f"{value:.6f}" for value in values]


def _eye_cells(eyes: EyeMeasures) -> list[str]:
    """Cells of `EYE_COLUMNS`, each empty by itself: one eye's camera may be lost."""
    values = np.stack([eyes.openness_mm, eyes.openness, eyes.pupil], axis=1).ravel()
    return ["" if np.isnan(value) else f"{value:.4f}" for value in values]


def _line(cells: list[str]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(cells)
    return buffer.getvalue()
