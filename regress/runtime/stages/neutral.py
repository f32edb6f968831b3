"""Estimates a person's neutral face from a recording in which nobody said which frames are neutral."""

import numpy as np

from regress.errors import InputError
from regress.runtime.calm import CalmFrames, calm_frames
from regress.runtime.features import extract
from regress.runtime.model import Model
from regress.runtime.networks import evaluate
from regress.targets import VISIBLE_SHAPES

_AGREEMENT = 0.1
"""Largest weight of a visible shape by which an early and a late half of the calm frames may differ."""


def estimate_neutral(model: Model, points: np.ndarray) -> CalmFrames:
    """Find the calm frames of a recording of one person, by the networks that see a frame alone.

    The calmest quarter is neutral if its early and its late half show the same face to the calibrated networks.

    Parameters
    ----------
    model
        With calibrated networks.
    points : (n, 68, 2) float64
        In the order of time; frames with NaN are left out.

    Raises
    ------
    InputError
        Where the model has no calibrated networks, or no frame is usable.
    """
    usable = np.flatnonzero(np.isfinite(points).all(axis=(1, 2)))
    if model.calibrated is None:
        raise InputError("the model has no calibrated networks, so a neutral frame is of no use to it")
    if not len(usable):
        raise InputError("no frame is usable: each has missing landmarks")
    networks = model.calibrated.networks
    visible = [name in VISIBLE_SHAPES for name in model.outputs]

    def difference(early: np.ndarray, late: np.ndarray) -> float:
        before, after = (
            np.median(extract(model.calibrated.features, points[half]), axis=0) for half in (early, late)
        )
        weights = evaluate(networks, np.stack([before - after, after - before]))
        return float(np.clip(weights[:, visible], 0, 1).max())

    activity = np.nansum(model.predict(points[usable]), axis=1)
    return calm_frames(activity, usable, difference=difference, agreement=_AGREEMENT)
