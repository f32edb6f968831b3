"""How far each weight of a frame can be trusted: by the network's own deviation and by the cameras that are there."""

import numpy as np

from regress.errors import InputError
from regress.headset.model import HeadsetModel


def confidence(model: HeadsetModel, deviation: np.ndarray, present: np.ndarray) -> np.ndarray:
    """Share of its variance that each weight is expected to explain in a frame.

    One less the network's predicted variance over the shape's own; where a camera is not present no more than
    the best of those that are explains by itself on unseen people.

    Parameters
    ----------
    deviation : (n, 52) float
        As the network gives it.
    present : (n, cameras) bool
        In the model's order.

    Returns
    -------
    (n, 52) float64
        [0, 1], in ``BLENDSHAPES`` order; 0 where no camera has a picture, or the shape never moved in the test.

    Raises
    ------
    InputError
        Where the model has no scores on unseen people.
    """
    if not model.scores:
        raise InputError("the model has no scores on a test split, from which confidence is made")
    shapes = [model.scores["shapes"][name]["uncalibrated"] for name in model.weights]
    alone = model.scores["cameras"]
    # R2 is one less the mean squared error over the shape's variance
    moves = np.array([shape["r2"] is not None for shape in shapes])
    variance = np.array(
        [shape["rmse"] ** 2 / (1 - shape["r2"]) for shape in shapes if shape["r2"] is not None]
    )
    share = np.zeros(deviation.shape)
    share[:, moves] = 1 - np.asarray(deviation, dtype=np.float64)[:, moves] ** 2 / variance
    best = np.array(
        [[alone.get(camera, {}).get(name) or 0.0 for name in model.weights] for camera in model.camera_names]
    )
    most = np.where(present[:, :, None], best, 0.0).max(axis=1)
    limit = np.where(present.all(axis=1)[:, None], 1.0, most)
    return np.clip(share, 0, np.clip(limit, 0, 1))
