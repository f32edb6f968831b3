"""The eight eyeLook shapes: from the gaze where irises are seen, else as the networks guess them from the lids."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLINK_INDICES
from regress.runtime.features.alignment import ANCHORS
from regress.runtime.features.reference_shape import load_reference_shape
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import BatchStage

FULL_YAW_RAD, FULL_PITCH_RAD = np.radians([30.0, 25.0])
"""Eye rotations at which an eyeLook weight reaches 1, as in the data that networks learn from."""

TURN_BORNE_RAD, TURN_TOO_FAR_RAD = np.radians([15.0, 25.0])
"""Yaw of the head up to which a guess from the lids stands, and from which it is 0.

On heads of another rig that turn and go on looking ahead the guess errs by .11, .12, .14 and .16 (root mean square, as
detected) at 15, 20, 25 and 30 degrees; the weights of people before a screen, whose eyes turn by 5 degrees, are .12:
beyond 20 degrees 0 is the better guess (benchmarks/gaze.py).
"""

WINK_BORNE, WINK_TOO_FAR = 0.2, 0.5
"""Difference between the eyes' blinks up to which a guess stands, and from which it is 0: winks show no gaze."""

_PAIRS = tuple(
    tuple(BLENDSHAPE_INDEX[name] for name in names)
    for names in (
        ("eyeLookOutLeft", "eyeLookInLeft"),
        ("eyeLookUpLeft", "eyeLookDownLeft"),
        ("eyeLookInRight", "eyeLookOutRight"),
        ("eyeLookUpRight", "eyeLookDownRight"),
    )
)
"""Shapes of turning to the subject's left or upwards, and of the opposite: in the order of a sample's gaze."""

LOOKS = [index for pair in _PAIRS for index in pair]


class Looks(BatchStage):
    """Sets the eyeLook weights of frames with a gaze, and fades those that lids cannot bear.

    Parameters
    ----------
    fade
        Whether guesses fade with a turn of the head and a wink.
    """

    def __init__(self, *, fade: bool) -> None:
        self._fade = fade

    def batch(self, samples: Sequence[Sample]) -> list[Sample]:
        """Samples with other weights and trust of the eight shapes, where they have weights."""
        if not self._fade and all(sample.gaze is None for sample in samples):
            return list(samples)
        return [self._looking(sample) for sample in samples]

    def _looking(self, sample: Sample) -> Sample:
        if np.isnan(sample.weights).any():
            return sample
        weights = sample.weights.copy()
        if sample.gaze is not None and np.isfinite(sample.gaze).all():
            weights[LOOKS] = look_weights(sample.gaze)
            trust = sample.confidence
            if trust is not None:
                trust = trust.copy()
                trust[LOOKS] = 1.0
            return replace(sample, weights=weights, confidence=trust)
        if not self._fade:
            return sample if sample.gaze is None else replace(sample, gaze=gaze_of(weights))
        share = borne(sample.points, weights[BLINK_INDICES])
        weights[LOOKS] *= share
        trust = sample.confidence
        if trust is not None:
            trust = trust.copy()
            trust[LOOKS] *= share
        # filters want a gaze in every frame of a take that has one
        gaze = None if sample.gaze is None else gaze_of(weights)
        return replace(sample, weights=weights, confidence=trust, gaze=gaze)


def look_weights(gaze: np.ndarray) -> np.ndarray:
    """The eight weights, in the order of `LOOKS`, of a gaze (4,): the inverse of what facegen makes of weights."""
    share = np.clip(gaze / np.tile([FULL_YAW_RAD, FULL_PITCH_RAD], 2), -1, 1)
    return np.stack([np.maximum(share, 0), np.maximum(-share, 0)], axis=1).ravel()


def gaze_of(weights: np.ndarray) -> np.ndarray:
    """The gaze (4,) that weights (52,) stand for."""
    plus, minus = (weights[list(side)] for side in zip(*_PAIRS, strict=True))
    return (plus - minus) * np.tile([FULL_YAW_RAD, FULL_PITCH_RAD], 2)


def borne(face: np.ndarray, blinks: np.ndarray) -> float:
    """Share of a guess from the lids that a face (68, 2) with these blinks (2,) bears."""
    turned = (TURN_TOO_FAR_RAD - abs(yaw_of(face))) / (TURN_TOO_FAR_RAD - TURN_BORNE_RAD)
    winking = (WINK_TOO_FAR - abs(float(blinks[0] - blinks[1]))) / (WINK_TOO_FAR - WINK_BORNE)
    return float(np.clip(turned, 0, 1) * np.clip(winking, 0, 1))


def yaw_of(face: np.ndarray) -> float:
    """Turn of a face (68, 2) towards its own left in radians, by an affine camera: quick, good to 2 degrees.

    `regress.runtime.features.turn` says how it is found.
    """
    sideways, outward = _solver() @ face
    length = np.linalg.norm(sideways)
    return float(np.arctan2(outward @ sideways / max(length, 1e-12), length))


@cache
def _solver() -> np.ndarray:
    """Gives of a face how points move in it with the mean face's x, and with its depth (2, 68)."""
    points = load_reference_shape().points
    anchors = list(ANCHORS)
    design = np.column_stack([points[anchors], np.ones(len(anchors))])
    rows = np.zeros((2, len(points)))
    rows[:, anchors] = np.linalg.pinv(design)[[0, 2]]
    return rows
