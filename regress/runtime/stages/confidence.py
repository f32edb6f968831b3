"""How far each weight of a frame can be trusted: what a shape's network can do, and how usual the face is to it."""

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.errors import InputError
from regress.runtime.features import extract
from regress.runtime.model import Model

ALONE, BESIDE_NEUTRAL = (0.75, 1.9), (0.7, 1.6)
"""Root mean square z-scores of a frame's features between which trust falls from all to none: of the networks that see
a frame alone, and of those beside a neutral frame.

Measured on 2,700 test faces with detectors' bias and jitter of 0 to 3 times the usual: the share of the variance
that the networks explain falls nearly on these lines (docs/measurements/using-a-model.md). A neutral frame takes the
bias off; what is left is noise, less of which makes the networks err. Training faces have 1 in the mean square.
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
    scores = {} if model.record is None else model.record.scores
    # calibrating uses up the calibrated networks, and the record still has their scores
    calibrated = model.calibrated is None and any("calibrated" in known for known in scores.values())
    best = np.zeros(len(BLENDSHAPES))
    for shape in model.outputs:
        used = "calibrated" if calibrated else "network"
        if used not in scores.get(shape, {}):
            raise InputError(
                f"the model's record has no test score of {shape}, from which confidence is made"
            )
        best[BLENDSHAPE_INDEX[shape]] = np.clip(scores[shape][used].r2 or 0.0, 0, 1)
    points = np.asarray(points, dtype=np.float64)
    return best * trust(distances(model, points), calibrated=calibrated)[:, None]


def distances(model: Model, points: np.ndarray) -> np.ndarray:
    """Root mean square z-score (n,) of each face's features; NaN where a face has missing points."""
    usable = np.isfinite(points).all(axis=(1, 2))
    found = np.full(len(points), np.nan)
    scores = extract(model.features, points[usable]) - model.normalisation.feature_mean
    found[usable] = np.sqrt(np.mean((scores / model.normalisation.feature_std) ** 2, axis=1))
    return found


def trust(distance: np.ndarray, *, calibrated: bool) -> np.ndarray:
    """1 for a face like those of the training, 0 for one that is strange to the networks, by its `distances`."""
    usual, strange = BESIDE_NEUTRAL if calibrated else ALONE
    return np.clip((strange - distance) / (strange - usual), 0, 1)
