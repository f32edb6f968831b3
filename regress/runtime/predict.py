"""From frames of landmarks to a table of weights."""

import csv
import io
from dataclasses import dataclass, field

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.errors import InputError
from regress.runtime.adjustment import ShapeAdjustment, adjust, blend_sides, mirror
from regress.runtime.inputs import Frames
from regress.runtime.model import Model
from regress.runtime.retargeting import Retargeting
from regress.runtime.smoothing import OneEuro, moving_average, one_euro, smooth_landmarks


@dataclass(frozen=True, kw_only=True)
class Prediction:
    """Weights of frames.

    Parameters
    ----------
    weights : (n, k) float64
        Columns as ``names`` says, by default in ``BLENDSHAPES`` order; rows of NaN where a frame has no face.
    frames
        What they were predicted from.
    names
        The k shapes.
    """

    weights: np.ndarray
    frames: Frames
    names: tuple[str, ...] = BLENDSHAPES


@dataclass(frozen=True, kw_only=True)
class Output:
    """What happens before and after the networks, in this order.

    Parameters
    ----------
    smooth_landmarks_hz
        Cutoff of a landmark at rest, of One-Euro smoothing before the networks; None for none.
    smooth
        Frames of the moving average; 1 leaves weights as they are.
    one_euro
        One-Euro smoothing by the frames' times; None for none.
    adjustments
        Gain, offset, dead zone and limits by shape.
    left_right_blend
        0 leaves left and right, 1 gives both their mean.
    mirror
        Exchange left and right.
    retargeting
        To other shapes than ARKit's, at the end.
    """

    smooth_landmarks_hz: float | None = None
    smooth: int = 1
    one_euro: OneEuro | None = None
    adjustments: dict[str, ShapeAdjustment] = field(default_factory=dict)
    left_right_blend: float = 0.0
    mirror: bool = False
    retargeting: Retargeting | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """What the columns that leave are called."""
        return BLENDSHAPES if self.retargeting is None else self.retargeting.names

    @property
    def needs_times(self) -> bool:
        """Whether every frame must have a time."""
        return self.one_euro is not None or self.smooth_landmarks_hz is not None

    def finish(self, weights: np.ndarray) -> np.ndarray:
        """Smoothed weights (n, 52) as they leave (n, k)."""
        if self.adjustments:
            weights = adjust(weights, self.adjustments)
        if self.left_right_blend > 0:
            weights = blend_sides(weights, self.left_right_blend)
        if self.mirror:
            weights = mirror(weights)
        return weights if self.retargeting is None else self.retargeting.apply(weights)


def predict_frames(model: Model, frames: Frames, *, output: Output | None = None) -> Prediction:
    """Weights of frames, finished as asked.

    Parameters
    ----------
    model, frames
        What to run on what; calibrate the model first where a neutral frame is known.
    output
        What happens before and after the networks; nothing by default.

    Raises
    ------
    InputError
        Where One-Euro smoothing is asked for and the frames' times are not known, or not in order.
    """
    output = output or Output()
    points, time_s = frames.points, frames.time_s
    if output.needs_times and time_s is None:
        raise InputError(f"{frames.source} does not say when its frames were taken; give --fps")
    if output.smooth_landmarks_hz is not None:
        points = smooth_landmarks(points, time_s, output.smooth_landmarks_hz, model.features.mean_shape)
    weights = moving_average(model.predict(points), output.smooth)
    if output.one_euro is not None:
        weights = one_euro(weights, time_s, output.one_euro)
    return Prediction(weights=output.finish(weights), frames=frames, names=output.names)


def prediction_csv(prediction: Prediction) -> str:
    """Text of a CSV: ``frame``, ``time_s`` where known, a column a shape; cells are empty without a face."""
    times = prediction.frames.time_s
    rows = [csv_header(prediction.names, timed=times is not None)]
    for row, (label, weights) in enumerate(zip(prediction.frames.labels, prediction.weights, strict=True)):
        rows.append(csv_row(label, None if times is None else float(times[row]), weights))
    return "".join(rows)


def csv_header(names: tuple[str, ...], *, timed: bool) -> str:
    """First line of a CSV of weights."""
    return _line(["frame", *(["time_s"] if timed else []), *names])


def csv_row(label: str, time_s: float | None, weights: np.ndarray) -> str:
    """One line of a CSV of weights (k,); no time cell for None, an empty one for NaN."""
    time_cell = [] if time_s is None else ["" if np.isnan(time_s) else f"{time_s:.6f}"]
    cells = [""] * len(weights) if np.isnan(weights).any() else [f"{weight:.6f}" for weight in weights]
    return _line([label, *time_cell, *cells])


def _line(cells: list[str]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(cells)
    return buffer.getvalue()
