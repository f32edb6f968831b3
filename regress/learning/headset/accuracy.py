"""Measures errors of predicted weights and gaze."""

import numpy as np

from facegen.conventions import BLENDSHAPES, BLINK_INDICES
from regress.learning.headset.geometry import FaceGeometry
from regress.runtime.headset.network.figures import Summary

OPEN = 0.3
"""Weight of eyeBlink up to which an eye counts as open."""

SCORED = [column for column, name in enumerate(BLENDSHAPES) if name != "tongueOut"]
"""Columns of the shapes that count in means: cameras hardly see a tongue."""


def summary(
    face: FaceGeometry, weights: np.ndarray, gaze: np.ndarray, true_weights: np.ndarray, true_gaze: np.ndarray
) -> Summary:
    """Figures of predicted weights (n, 52) and gaze (n, 2, 2)."""
    error = (np.asarray(weights, np.float64) - true_weights)[:, SCORED]
    r2 = r2_of(weights, true_weights)
    gaze_error = gaze_error_deg(gaze, true_gaze)
    is_open = true_weights[:, BLINK_INDICES] < OPEN
    return Summary(
        rows=len(weights),
        geometry_mm=float(face.error_mm(weights, true_weights).mean()),
        r2=_mean(r2[SCORED]),
        mae=float(np.abs(error).mean()),
        rmse=float(np.sqrt(np.mean(error**2))),
        blink_r2=_mean(r2[BLINK_INDICES]),
        gaze_deg=float(gaze_error.mean()),
        gaze_open_deg=float(gaze_error[is_open].mean()) if is_open.any() else None,
    )


def r2_of(predicted: np.ndarray, true: np.ndarray) -> np.ndarray:
    """Share of each column's variance explained, (O,) float64; NaN where a column does not move."""
    true = np.asarray(true, np.float64)
    variance = true.var(axis=0)
    wrong = np.mean((np.asarray(predicted, np.float64) - true) ** 2, axis=0)
    return np.where(variance > 0, 1 - wrong / np.where(variance > 0, variance, 1), np.nan)


def gaze_error_deg(predicted: np.ndarray, true: np.ndarray) -> np.ndarray:
    """Angle (n, 2) float64 in degrees between gaze directions (n, 2, 2): yaw and pitch of both eyes, radians."""
    one, other = _axis(predicted), _axis(true)
    # the sine as well: the cosine alone loses small angles
    crossed = np.linalg.norm(np.cross(one, other), axis=-1)
    return np.rad2deg(np.arctan2(crossed, np.sum(one * other, axis=-1)))


def share_better(error: np.ndarray, rival_error: np.ndarray) -> float:
    """Share of frames in which the first error (n,) is smaller; ties count half."""
    return float(np.mean((error < rival_error) + 0.5 * (error == rival_error)))


def _axis(gaze: np.ndarray) -> np.ndarray:
    yaw, pitch = np.moveaxis(np.asarray(gaze, np.float64), -1, 0)
    return np.stack([np.sin(yaw) * np.cos(pitch), np.sin(pitch), np.cos(yaw) * np.cos(pitch)], axis=-1)


def _mean(values: np.ndarray) -> float | None:
    defined = values[~np.isnan(values)]
    return float(defined.mean()) if len(defined) else None
