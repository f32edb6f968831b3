"""How far each weight of a frame can be trusted: what a shape's network can do, and how usual the face is to it."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.errors import InputError
from regress.features import extract
from regress.model import Model

USUAL, STRANGE = 0.75, 1.9
"""Root mean square z-scores of a frame's features between which trust falls from all to none.

Measured on 2,700 test faces with detectors' bias and jitter of 0 to 3 times the usual: the share of the variance
that the networks explain falls nearly on a line, from its best at 0.75 to nothing at 1.9, frames alone; with a neutral
frame it is above that line, and falls to nothing from 1.5 to 1.7 (docs/using-a-model.md). Training faces have 1 in the
mean square.
"""


def confidence(model: Model, points: np.ndarray) -> np.ndarray:
    """Share of its variance that each weight is expected to explain in faces like these.

    The R2 of the shape on the test split, less the further a frame's features lie from those that the networks
    were trained on. It speaks of the model and of the landmarks' likeness to training faces; a plausible face that
    a detector put into the wrong place passes for a good one.

    Parameters
    ----------
    model
        Calibrated or not; the scores of the networks in use are taken from its training record.
    points : (n, 68, 2) float
        Faces in pixels or any other unit, y down.

    Returns
    -------
    (n, 52) float64
        [0, 1], in ``BLENDSHAPES`` order, 0 where a shape is not observable; NaN where a face has missing points.

    Raises
    ------
    InputError
        Where the model's record has no scores.
    """
    scores = model.record.get("scores", {})
    best = np.zeros(len(BLENDSHAPES))
    for shape in model.outputs:
        known = scores.get(shape, {})
        # calibrating uses up the calibrated networks, and the record still has their scores
        used = "calibrated" if model.calibrated is None and "calibrated" in known else "network"
        if used not in known:
            raise InputError(
                f"the model's record has no test score of {shape}, from which confidence is made"
            )
        best[BLENDSHAPE_INDEX[shape]] = np.clip(known[used]["r2"] or 0.0, 0, 1)
    return best * _usualness(model, np.asarray(points, dtype=np.float64))[:, None]


def _usualness(model: Model, points: np.ndarray) -> np.ndarray:
    """1 for a face (n,) like those of the training, 0 for one that is strange to the networks."""
    usable = np.isfinite(points).all(axis=(1, 2))
    usual = np.full(len(points), np.nan)
    spread = model.normalisation.feature_std
    scores = (extract(model.features, points[usable]) - model.normalisation.feature_mean) / spread
    distance = np.sqrt(np.mean(scores**2, axis=1))
    usual[usable] = np.clip((STRANGE - distance) / (STRANGE - USUAL), 0, 1)
    return usual
