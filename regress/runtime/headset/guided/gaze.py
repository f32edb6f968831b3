"""Says what sets one eye's gaze right, of a take in which things were looked at."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from regress.runtime.headset.eyes.glances import glances
from regress.runtime.headset.eyes.own_gaze import own_gaze

HALF_APART_M = 0.0315
"""From between the eyes to one of them: half of 63 mm (N. Dodgson, "Variation and extrema of human interpupillary
distance", 2004)."""

_MISSED_DEG = 8.0
"""Off its targets by more than this a gaze is of other targets: eyes miss by 3 degrees in headsets that were drawn."""


def of_one_eye(targets_deg: np.ndarray, side: int, distance_m: float) -> np.ndarray:
    """Targets (k, 2) in degrees from between the eyes as one eye sees them: near ones turn both eyes inwards."""
    inwards = np.degrees(np.arctan(HALF_APART_M / distance_m * np.cos(np.radians(targets_deg[:, 0]))))
    return targets_deg + np.column_stack([(-inwards, inwards)[side], np.zeros(len(targets_deg))])


def gaze_of_targets(
    camera: str,
    side: int,
    answers: Mapping[str, np.ndarray],
    openness: np.ndarray,
    targets_deg: Mapping[int, tuple[float, float]],
    *,
    distance_m: float,
    fps: float,
) -> tuple[dict[str, Any], list[str]]:
    """Fields of an ``OwnEye``, and sentences on targets that say nothing.

    Parameters
    ----------
    side
        0 is the subject's left eye.
    answers
        (n, 2) in degrees of ``"traced"`` and ``"direct"``; a model without a map from points to the gaze has the
        second alone.
    openness : (n,)
        As a share of the take's own.
    targets_deg
        Yaw and pitch of what was looked at from between the eyes, by frame.
    """
    rows = list(targets_deg)
    targets = np.array([targets_deg[row] for row in rows], dtype=np.float64)
    looked = glances(list(answers.values()), openness, np.arange(len(openness)) / fps, rows)
    seen = np.flatnonzero(np.isfinite(looked).all(axis=(0, 2)))
    own = own_gaze(
        [each[seen] for each in looked], of_one_eye(targets[seen].reshape(-1, 2), side, distance_m)
    )
    missed = {int(seen[place]): off for place, off in own.missed_deg.items()}
    notes = []
    for place, (yaw, pitch) in enumerate(targets):
        if place in missed:
            notes.append(
                f"look: {camera} misses the target at {yaw:g}:{pitch:g} by {missed[place]:.0f} degrees, far more than "
                f"others; it is left out"
            )
        elif place not in seen:
            notes.append(f"look: {camera} sees no open eye at the target {yaw:g}:{pitch:g}; it is left out")
    if own.error_deg > _MISSED_DEG:
        notes.append(
            f"look: {camera} is off its targets by {own.error_deg:.0f} degrees even so; are their signs (left and up "
            f"are positive) and frame numbers right?"
        )
    if not len(seen):
        return {}, notes
    # few targets do not show which answer is the better one; in the training's own headset it is the direct one
    share = float(own.shares[0]) if own.decided and "traced" in answers else 0.0
    fields = {name: _rows(one) for name, one in zip(answers, own.maps, strict=True)}
    return fields | {"traced_share": share, "error_deg": own.error_deg}, notes


def gaze_centred(answers: Mapping[str, np.ndarray]) -> dict[str, Any]:
    """The same of a take without targets: the middle of what was looked at lies ahead."""
    middles = [
        np.nanquantile(each, [0.1, 0.9], axis=0).mean(axis=0, keepdims=True) for each in answers.values()
    ]
    own = own_gaze(middles, np.zeros((1, 2)))
    fields = {name: _rows(one) for name, one in zip(answers, own.maps, strict=True)}
    return fields | {"traced_share": 0.0, "error_deg": own.error_deg}


def _rows(affine: np.ndarray) -> tuple[tuple[float, ...], ...]:
    return tuple(map(tuple, affine.tolist()))
