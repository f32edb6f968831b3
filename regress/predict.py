"""From frames of landmarks to a table of weights."""

import csv
import io
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.inputs import Frames
from regress.model import Model


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


def predict_frames(model: Model, frames: Frames, *, smooth: int = 1) -> Prediction:
    """Weights of frames, smoothed over time where asked.

    Parameters
    ----------
    model, frames
        What to run on what.
    smooth
        Frames of the moving average; 1 leaves weights as they are.
    """
    return Prediction(weights=moving_average(model.predict(frames.points), smooth), frames=frames)


def moving_average(weights: np.ndarray, frames: int) -> np.ndarray:
    """Mean of each row and those before it, ``frames`` in all, fewer at the start: what a live stream has.

    Rows of NaN stay NaN, and other rows' means leave them out.

    Parameters
    ----------
    weights : (n, k) float64
    frames
        1 or more.
    """
    if frames <= 1:
        return weights
    known = ~np.isnan(weights)
    sums = np.cumsum(np.where(known, weights, 0), axis=0)
    counts = np.cumsum(known, axis=0)
    sums[frames:] -= sums[:-frames].copy()
    counts[frames:] -= counts[:-frames].copy()
    # The running sum leaves rounding of 1e-16 a frame behind: back into the range that its terms had.
    mean = np.clip(sums / np.maximum(counts, 1), 0, 1)
    return np.where(known, mean, np.nan)


def prediction_csv(prediction: Prediction) -> str:
    """Text of a CSV: ``frame``, ``time_s`` where known, 52 ARKit columns; cells are empty without a face."""
    times = prediction.frames.time_s
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(["frame", *(["time_s"] if times is not None else []), *BLENDSHAPES])
    for row, (label, weights) in enumerate(zip(prediction.frames.labels, prediction.weights, strict=True)):
        time_cell = [f"{times[row]:.6f}"] if times is not None else []
        cells = [""] * len(weights) if np.isnan(weights).any() else [f"{weight:.6f}" for weight in weights]
        writer.writerow([label, *time_cell, *cells])
    return buffer.getvalue()
