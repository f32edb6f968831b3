"""Measures error against head pose: the same faces, turned to each pose of a grid."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regress.learning.probes.faces import ProbeFaces
from regress.learning.probes.methods import Method
from regress.learning.training.preparation import OUTPUT_COLUMNS

YAW_DEG = (-40.0, -30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0)
PITCH_DEG = (-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0)
WITHIN_DEG = 20.0
"""Poses up to here in yaw and pitch are a webcam's everyday; the loss against frontal is stated over them."""

_FACES = 1000
"""More change no mean by a thousandth; all poses of so many faces take a few seconds."""


@dataclass(frozen=True, kw_only=True)
class PoseErrors:
    """Errors of one method on exact points of turned faces.

    Parameters
    ----------
    method : str
    calibrated : bool
        The neutral frame is then a frontal one: people hold still for one picture, then turn.
    mae : (P, Y, O) float64
        Mean absolute error by pitch (``PITCH_DEG``), yaw (``YAW_DEG``) and shape.
    mse : (P, Y, O) float64
        Mean squared error.
    variance : (O,) float64
        Of the true weights.
    """

    method: str
    calibrated: bool
    mae: np.ndarray
    mse: np.ndarray
    variance: np.ndarray

    @property
    def frontal_r2(self) -> np.ndarray:
        """R2 (O,) at yaw 0 and pitch 0; NaN where a shape never moves."""
        return self._r2(self.mse[_is_frontal()][0])

    @property
    def turned_r2(self) -> np.ndarray:
        """R2 (O,) over all other poses within ``WITHIN_DEG``."""
        return self._r2(self.mse[_is_turned()].mean(axis=0))

    @property
    def loss(self) -> np.ndarray:
        """What turning the head costs each shape (O,): frontal R2 less R2 of turned faces."""
        return self.frontal_r2 - self.turned_r2

    @property
    def mae_rise(self) -> np.ndarray:
        """Mean absolute error (O,) of turned faces less that of frontal ones, in weights."""
        return self.mae[_is_turned()].mean(axis=0) - self.mae[_is_frontal()][0]

    def _r2(self, mse: np.ndarray) -> np.ndarray:
        moves = self.variance > 0
        return np.where(moves, 1 - mse / np.where(moves, self.variance, 1.0), np.nan)


def _is_frontal() -> np.ndarray:
    pitch, yaw = np.meshgrid(PITCH_DEG, YAW_DEG, indexing="ij")
    return (yaw == 0) & (pitch == 0)


def _is_turned() -> np.ndarray:
    """(P, Y) bool: within ``WITHIN_DEG``, but not frontal."""
    pitch, yaw = np.meshgrid(PITCH_DEG, YAW_DEG, indexing="ij")
    return (np.abs(yaw) <= WITHIN_DEG) & (np.abs(pitch) <= WITHIN_DEG) & ~_is_frontal()


def pose_errors(
    methods: Sequence[Method], faces: ProbeFaces, neutral: ProbeFaces, *, count: int = _FACES
) -> tuple[PoseErrors, ...]:
    """Turn at most ``count`` faces to every pose and ask every method; neutral frames stay frontal."""
    faces, neutral = faces.some(count), neutral.some(count)
    true = faces.weights[:, OUTPUT_COLUMNS]
    beside = neutral.turned(yaw_deg=0, pitch_deg=0)
    errors = np.empty((len(methods), 2, len(PITCH_DEG), len(YAW_DEG), true.shape[1]))
    for row, pitch_deg in enumerate(PITCH_DEG):
        for column, yaw_deg in enumerate(YAW_DEG):
            shown = faces.turned(yaw_deg=yaw_deg, pitch_deg=pitch_deg)
            for number, method in enumerate(methods):
                error = method.predict(shown, beside) - true
                errors[number, 0, row, column] = np.abs(error).mean(axis=0)
                errors[number, 1, row, column] = (error**2).mean(axis=0)
    return tuple(
        PoseErrors(
            method=method.name, calibrated=method.calibrated, mae=mae, mse=mse, variance=true.var(axis=0)
        )
        for method, (mae, mse) in zip(methods, errors, strict=True)
    )
