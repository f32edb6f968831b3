"""What a person's profile says of the answers: own full movements read as 1, eyes and heads that look ahead as 0."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from facegen.conventions import BLINK_INDICES
from regress.runtime.heads.fit import FACING
from regress.runtime.headset.network.parts import side_of
from regress.runtime.sample import Sample
from regress.runtime.stages.gaze import LOOKS, look_weights
from regress.runtime.stages.head import angles_of
from regress.runtime.stages.own_blinks import WHOLE, Ends
from regress.runtime.stages.stage import Stage
from track.profile.profile import Profile
from track.session.gaze import poses_of
from track.session.showing import SHUT

_BLINK_NAMES = ("eyeBlinkLeft", "eyeBlinkRight")


class Ranges(Stage):
    """Takes what each weight reads at rest away, and stretches it by its factor.

    Attributes
    ----------
    factors, rests : (52,) float64
        May be changed between two frames.
    by_lids : (2,) bool
        Of which eyes the blink is what traced lids say, the left one first.
    """

    def __init__(self, factors: np.ndarray, rests: np.ndarray, by_lids: np.ndarray) -> None:
        self.factors, self.rests, self.by_lids = factors, rests, by_lids

    def step(self, sample: Sample) -> Sample:
        """The sample with weights in [0, 1]; NaN stays."""
        weights = np.clip((sample.weights - self.rests) * self.factors, 0.0, 1.0)
        if sample.eyes is not None and self.by_lids.any():
            shut = np.clip(1 - sample.eyes.openness, 0, 1)
            said = self.by_lids & np.isfinite(shut) & np.isfinite(weights[BLINK_INDICES])
            weights[BLINK_INDICES] = np.where(said, shut, weights[BLINK_INDICES])
        return replace(sample, weights=weights)


class GazeCentre(Stage):
    """Takes away what the eyes read when they look straight ahead.

    Attributes
    ----------
    centre : (4,) float64
        Radians; zeros where nobody has looked yet.
    """

    def __init__(self, centre: np.ndarray) -> None:
        self.centre = centre

    def step(self, sample: Sample) -> Sample:
        """The sample with its gaze about the centre, and the looks that follow; one without a gaze as it is."""
        if sample.gaze is None or not self.centre.any() or np.isnan(sample.gaze).any():
            return sample
        gaze = sample.gaze - self.centre
        weights = sample.weights.copy()
        weights[LOOKS] = look_weights(gaze)
        return replace(sample, gaze=gaze, weights=weights)


class HeadCentre(Stage):
    """Takes away how the head reads turned when it looks straight ahead; where it is stays.

    Attributes
    ----------
    centre : (3,) float64
        Yaw, pitch and roll in radians; zeros where nobody has said it.
    """

    def __init__(self, centre: np.ndarray) -> None:
        self.centre = centre

    def step(self, sample: Sample) -> Sample:
        """The sample with its head as the screen sees it; one without a head as it is."""
        if sample.head is None or not self.centre.any() or np.isnan(sample.head).any():
            return sample
        ahead, turn = _turns(np.stack([self.centre, sample.head[3:]]))
        return replace(
            sample, head=np.concatenate([sample.head[:3], angles_of(FACING @ ahead.T @ turn[None])[0]])
        )


def _turns(angles: np.ndarray) -> np.ndarray:
    """Rotations (n, 3, 3) of heads with these angles (n, 3), out of looking into the camera."""
    heads = np.concatenate([np.zeros_like(angles), angles], axis=1)
    return FACING @ poses_of(heads).rotation


def by_lids(profile: Profile) -> np.ndarray:
    """(2,) bool: eyes whose blink the network does not read when they are shut, while traced lids do."""
    found = np.zeros(2, dtype=bool)
    for camera, eye in profile.eyes.items():
        side = {"left": 0, "right": 1}.get(side_of(camera) or "")
        if side is None:
            continue
        shut = eye.shut_mm is not None and eye.rest_mm is not None and eye.shut_mm < SHUT * eye.rest_mm
        found[side] = shut and _BLINK_NAMES[side] not in profile.ranges
    return found


def blinks_known(profile: Profile) -> np.ndarray:
    """(2,) bool: eyes whose full blink the profile knows, by the network's reading or by traced lids."""
    return by_lids(profile) | np.array([name in profile.ranges for name in _BLINK_NAMES])


def ends_of(profile: Profile) -> tuple[Ends, Ends]:
    """What is known of both eyes' blinks, the left one first."""
    left, right = (profile.blinks.get(name, WHOLE) for name in _BLINK_NAMES)
    return left, right


def blinks_of(ends: Sequence[Ends]) -> dict[str, Ends]:
    """Both eyes' blinks, the left one first, as a profile holds them."""
    return dict(zip(_BLINK_NAMES, ends, strict=True))


def middle_of(gazes: Sequence[np.ndarray | None]) -> tuple[float, ...] | None:
    """Middle (4 radians) between the ends of what was looked at: it lies ahead; None where no gaze is known."""
    known = [gaze for gaze in gazes if gaze is not None and np.isfinite(gaze).all()]
    if not known:
        return None
    return tuple(float(angle) for angle in np.quantile(known, [0.1, 0.9], axis=0).mean(axis=0))
