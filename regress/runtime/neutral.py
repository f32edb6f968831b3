"""A person's neutral face from a recording in which nobody said which frames are neutral."""

from dataclasses import dataclass

import numpy as np

from regress.errors import InputError
from regress.runtime.features import extract
from regress.runtime.model import Model
from regress.runtime.networks import evaluate
from regress.targets import VISIBLE_SHAPES

_CALM_SHARE = 0.25
"""Frames taken for neutral: the quarter that shows least, as people's faces rest most of the time."""

_FEWEST_CALM = 8
"""Calm frames below which nothing is certain; ten are what the literature averages."""

_AGREEMENT = 0.1
"""Largest weight of a visible shape by which an early and a late half of the calm frames may differ."""


@dataclass(frozen=True, kw_only=True)
class NeutralEstimate:
    """Which frames of a recording look neutral, and whether that can be relied on.

    Parameters
    ----------
    frames : (m,) int64
        Numbers of the calm frames, in order.
    sure
        Whether they are enough and agree.
    reason
        Why, in a sentence.
    """

    frames: np.ndarray
    sure: bool
    reason: str


def estimate_neutral(model: Model, points: np.ndarray) -> NeutralEstimate:
    """Find the calm frames of a recording of one person.

    The networks that see a frame alone say how much is going on in it: a detector's bias shifts all frames
    of a recording alike and leaves their order. The calmest quarter is neutral if its early and its late half
    show the same face to the calibrated networks. Someone who smiles throughout is taken for neutral: a
    frame named by a person is better than an estimate.

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
    activity = np.nansum(model.predict(points[usable]), axis=1)
    count = max(1, round(_CALM_SHARE * len(usable)))
    calm = np.sort(np.argsort(activity, kind="stable")[:count])
    frames = usable[calm]
    if count < _FEWEST_CALM:
        fewest = int(_FEWEST_CALM / _CALM_SHARE)
        reason = f"{len(usable)} frames have a face, and {fewest} are needed"
        return NeutralEstimate(frames=frames, sure=False, reason=reason)
    features = extract(model.features, points[frames])
    early, late = (np.median(half, axis=0) for half in np.array_split(features, 2))
    between = np.stack([early - late, late - early])
    visible = [name in VISIBLE_SHAPES for name in model.outputs]
    difference = float(np.clip(evaluate(model.calibrated.networks, between)[:, visible], 0, 1).max())
    if difference > _AGREEMENT:
        reason = f"calm frames differ by weights of up to {difference:.2f}, and {_AGREEMENT} is allowed"
        return NeutralEstimate(frames=frames, sure=False, reason=reason)
    reason = f"{count} calm frames of {len(usable)} agree to {difference:.2f}"
    return NeutralEstimate(frames=frames, sure=True, reason=reason)
