"""From frames of landmarks to a table of weights."""

import csv
import io
from dataclasses import dataclass, field

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.adjustment import ShapeAdjustment, adjust, blend_sides, mirror
from regress.errors import InputError
from regress.inputs import Frames
from regress.model import Model
from regress.smoothing import OneEuro, moving_average, one_euro


@dataclass(frozen=True, kw_only=True)
class Prediction:
    """Weights of frames.

    Parameters
    ----------
    weights : (n, 52) float64
        In ``BLENDSHAPES`` order, [0, 1]; rows of NaN where a frame has no face.
    frames
        What they were predicted from.
    """

    weights: np.ndarray
    frames: Frames

    @property
    def empty_rows(self) -> list[int]:
        """Rows without weights, counted from 1 as a table's rows below its header."""
        return [int(row) + 1 for row in np.flatnonzero(np.isnan(self.weights).any(axis=1))]


@dataclass(frozen=True, kw_only=True)
class Output:
    """What happens to weights after the networks, in this order.

    Parameters
    ----------
    smooth
        Frames of the moving average; 1 leaves weights as they are.
    one_euro
        One-Euro smoothing by the frames' times; None for none.
    adjustments
        Gain, offset, dead zone and limits by shape.
    left_right_blend
        0 leaves left and right, 1 gives both their mean.
    mirror
        Exchange left and right at the end.
    """

    smooth: int = 1
    one_euro: OneEuro | None = None
    adjustments: dict[str, ShapeAdjustment] = field(default_factory=dict)
    left_right_blend: float = 0.0
    mirror: bool = False

    def finish(self, weights: np.ndarray) -> np.ndarray:
        """Smoothed weights (n, 52) as they leave."""
        if self.adjustments:
            weights = adjust(weights, self.adjustments)
        if self.left_right_blend > 0:
            weights = blend_sides(weights, self.left_right_blend)
        return mirror(weights) if self.mirror else weights


def predict_frames(model: Model, frames: Frames, *, output: Output | None = None) -> Prediction:
    """Weights of frames, finished as asked.

    Parameters
    ----------
    model, frames
        What to run on what; calibrate the model first where a neutral frame is known.
    output
        What happens after the networks; nothing by default.

    Raises
    ------
    InputError
        Where One-Euro smoothing is asked for and the frames' times are not known, or not in order.
    """
    output = output or Output()
    weights = moving_average(model.predict(frames.points), output.smooth)
    if output.one_euro is not None:
        if frames.time_s is None:
            raise InputError(f"{frames.source} does not say when its frames were taken; give --fps")
        weights = one_euro(weights, frames.time_s, output.one_euro)
    return Prediction(weights=output.finish(weights), frames=frames)


def prediction_csv(prediction: Prediction) -> str:
    """Text of a CSV: ``frame``, ``time_s`` where known, 52 ARKit columns; cells are empty without a face."""
    times = prediction.frames.time_s
    rows = [csv_header(timed=times is not None)]
    for row, (label, weights) in enumerate(zip(prediction.frames.labels, prediction.weights, strict=True)):
        rows.append(csv_row(label, None if times is None else float(times[row]), weights))
    return "".join(rows)


def csv_header(*, timed: bool) -> str:
    """First line of a CSV of weights."""
    return _line(["frame", *(["time_s"] if timed else []), *BLENDSHAPES])


def csv_row(label: str, time_s: float | None, weights: np.ndarray) -> str:
    """One line of a CSV of weights (52,)."""
    time_cell = [] if time_s is None else [f"{time_s:.6f}"]
    cells = [""] * len(weights) if np.isnan(weights).any() else [f"{weight:.6f}" for weight in weights]
    return _line([label, *time_cell, *cells])


def _line(cells: list[str]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(cells)
    return buffer.getvalue()
