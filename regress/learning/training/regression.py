"""Counts predicted against true weights of a split in cells, as the paper's figure 3 plots them."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.learning.training.dataset import KeypointDataset
from regress.runtime.model import Model, Regression

CELLS = 51
"""Cells a side, 0.02 wide and centred on 0, 0.02 ... 1: weights of 0 and 1 fall into the middle of one."""


def regression(predicted: np.ndarray, true: np.ndarray) -> Regression:
    """Count and fit two arrays of equal shape; weights beyond [0, 1] count in the outermost cells."""
    predicted, true = np.ravel(predicted), np.ravel(true)
    cells = [
        np.clip(np.rint(values * (CELLS - 1)), 0, CELLS - 1).astype(np.int64) for values in (true, predicted)
    ]
    counts = np.bincount(cells[0] * CELLS + cells[1], minlength=CELLS**2).reshape(CELLS, CELLS)
    variance, spread = true.var(), predicted.var()
    covariance = np.mean((true - true.mean()) * (predicted - predicted.mean()))
    slope = float(covariance / variance) if variance > 0 else None
    return Regression(
        counts=counts.tolist(),
        slope=slope,
        intercept=None if slope is None else float(predicted.mean() - slope * true.mean()),
        pearson=float(covariance / np.sqrt(variance * spread)) if variance > 0 and spread > 0 else None,
    )


def regress_split(model: Model, dataset: KeypointDataset, *, split: str) -> Regression:
    """The regression of a model's outputs, as predicted, on one split of a dataset."""
    rows = dataset.rows(split)
    columns = [BLENDSHAPE_INDEX[name] for name in model.outputs]
    return regression(model.predict(dataset.points[rows])[:, columns], dataset.weights[rows][:, columns])
