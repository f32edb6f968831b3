"""How far each weight of a frame can be trusted: by the network's own deviation and by the cameras that are there."""

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.model import HeadsetModel


def confidence(
    model: HeadsetModel, deviation: np.ndarray, present: np.ndarray, calibrated: np.ndarray
) -> np.ndarray:
    """Share of its variance that each weight is expected to explain in a frame.

    On unseen people the network's error explains R2; a frame for which it predicts a larger error than its usual one
    explains less, as the variances have it, and none explains more. Where a camera is not present it is no more than
    the best of those that are explains by itself.

    Parameters
    ----------
    deviation : (n, 52) float
        As the network gives it.
    present : (n, cameras) bool
        In the model's order.
    calibrated : (n,) bool
        Frames that are compared with neutral pictures, which have scores of their own.

    Returns
    -------
    (n, 52) float64
        [0, 1], in ``BLENDSHAPES`` order; 0 where no camera has a picture, or the shape never moved in the test.

    Raises
    ------
    InputError
        Where the model has no scores on unseen people.
    """
    if model.scores is None:
        raise InputError("the model has no scores on a test split, from which confidence is made")
    alone = model.scores.cameras
    best = np.array(
        [[alone.get(camera, {}).get(name) or 0.0 for name in model.weights] for camera in model.camera_names]
    )
    most = np.where(present[:, :, None], best, 0.0).max(axis=1)
    limit = np.where(present.all(axis=1)[:, None], 1.0, np.clip(most, 0, 1))
    trust = np.zeros(deviation.shape)
    for rows, condition in ((~calibrated, "uncalibrated"), (calibrated, "same_seat")):
        trust[rows] = _explained(model, np.asarray(deviation, dtype=np.float64)[rows], condition)
    return np.minimum(trust, limit)


def _explained(model: HeadsetModel, deviation: np.ndarray, condition: str) -> np.ndarray:
    explained = np.zeros(deviation.shape)
    for column, name in enumerate(model.weights):
        figures = model.scores.shapes[name]
        known = figures.get(condition, figures["uncalibrated"])
        if known.r2 is not None and known.rmse > 0:
            # R2 is one less the mean squared error over the shape's variance
            excess = np.maximum(deviation[:, column] ** 2 / known.rmse**2, 1.0)
            explained[:, column] = np.clip(1 - (1 - known.r2) * excess, 0, 1)
    return explained
