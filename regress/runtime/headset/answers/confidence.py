"""How far each weight of a frame can be trusted: by the network's own deviation and by the cameras that are there."""

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.network.model import HeadsetModel


class HeadsetConfidence:
    """Share of its variance that each weight is expected to explain in a frame.

    On unseen people the network's error explains R2; a frame for which it predicts a larger error than its usual one
    explains less, as the variances have it, and none explains more. Where a camera is not present it is no more than
    the best of those that are explains by itself.

    Parameters
    ----------
    model
        Its scores are read once, so that a live frame costs microseconds.

    Raises
    ------
    InputError
        Where the model has no scores on unseen people.
    """

    def __init__(self, model: HeadsetModel) -> None:
        if model.scores is None:
            raise InputError("the model has no scores on a test split, from which confidence is made")
        alone = model.scores.cameras
        self._alone = np.array(
            [
                [alone.get(camera, {}).get(name) or 0.0 for name in model.weights]
                for camera in model.camera_names
            ]
        )
        self._usual = tuple(_usual(model, condition) for condition in ("uncalibrated", "same_seat"))

    def of_frame(self, deviation: np.ndarray, present: np.ndarray, *, calibrated: bool) -> np.ndarray:
        """Trust in one frame's weights.

        Parameters
        ----------
        deviation : (52,) float
            As the network gives it.
        present : (cameras,) bool
            In the model's order.
        calibrated
            Whether the frame is compared with neutral pictures, which have scores of their own.

        Returns
        -------
        (52,) float64
            [0, 1], in ``BLENDSHAPES`` order; 0 where no camera has a picture, or the shape never moved in the test.
        """
        unexplained, variance = self._usual[int(calibrated)]
        # R2 is one less the mean squared error over the shape's variance
        excess = np.maximum(np.asarray(deviation, dtype=np.float64) ** 2 / variance, 1.0)
        explained = np.clip(1 - unexplained * excess, 0, 1)
        if np.all(present):
            return explained
        return np.minimum(explained, np.clip(self._alone[present].max(axis=0, initial=0.0), 0, 1))


def _usual(model: HeadsetModel, condition: str) -> tuple[np.ndarray, np.ndarray]:
    """Share of variance not explained (52,) and usual squared error (52,); 1 and 1 where a shape never moved."""
    figures = [model.scores.shapes[name] for name in model.weights]
    known = [shape.get(condition, shape["uncalibrated"]) for shape in figures]
    moved = [one.r2 is not None and one.rmse > 0 for one in known]
    return (
        np.array([1 - one.r2 if there else 1.0 for one, there in zip(known, moved, strict=True)]),
        np.array([one.rmse**2 if there else 1.0 for one, there in zip(known, moved, strict=True)]),
    )
