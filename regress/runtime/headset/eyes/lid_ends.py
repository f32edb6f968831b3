"""Finds how far apart a person's lids are when open and when shut, in a take of which nobody has said so.

Of real eyes a network traces shut lids about half as far apart as open ones. Nobody has to be asked where shut is:
people blink, and nothing else of a lid goes down and up within half a second.
"""

import numpy as np

from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.eyes.gaze_map import IRIS_MM
from regress.runtime.headset.eyes.iris_diameter import diameter_of, mean_length
from regress.runtime.stages.own_blinks import BlinkWatch

OWN_OPENNESS = 90.0
"""Percentile of a take's open eyes that counts as the person's own: wide eyes are above."""

_USUAL_OPENNESS = 0.85
"""Lids of the mean of training's frames, over those of the resting eye: some of these frames are shut. Neutral frames
of 60 other people read 1.00 in the median."""

_NARROWEST = 0.7
"""Of the usual opening, that a person's own has at least: an eye that is shut all through is no open one."""

_ENDS, _BOTH_SEEN = (2.0, 98.0), 0.7
"""Percentiles between which a take's lids move, and what the lower is of the upper where both ends are seen: frames
above their middle are then of open eyes, however few."""

_DEEP, _FEWEST = 0.35, 3
"""By how much of the opening a dip goes down that is of a shut eye, as real ones read .43 to .52 of it; and how many
have to be seen, as one may be a hand's."""


def usual_opening_mm(eye: EyePoints) -> float:
    """How far apart the lids of a resting eye are in training."""
    apart = mean_length(eye.usual[eye.upper] - eye.usual[eye.lower])
    return IRIS_MM * apart / _USUAL_OPENNESS / diameter_of(eye.usual, eye)


def lid_ends_mm(apart_mm: np.ndarray, time_s: np.ndarray, *, usual_mm: float) -> tuple[float, float]:
    """How far apart a take's lids are when open and when shut; 0 is shut where too few blinks were seen.

    Parameters
    ----------
    apart_mm : (n,)
        Of each frame; NaN where the eye is not seen.
    time_s : (n,)
        Rising.
    usual_mm
        As `usual_opening_mm` says it.
    """
    known = apart_mm[np.isfinite(apart_mm)]
    low, high = np.percentile(known, _ENDS) if len(known) else (np.nan, np.nan)
    opened = known[known > (low + high) / 2] if low < _BOTH_SEEN * high else known
    own = float(np.percentile(opened, OWN_OPENNESS)) if len(opened) else usual_mm
    own = max(own, _NARROWEST * usual_mm)
    watch = BlinkWatch(remembered=None)
    for moment, apart in zip(time_s, apart_mm, strict=True):
        watch.step(float(moment), 1 - float(apart) / own)
    deep = [peak for peak in watch.peaks if peak >= _DEEP]
    return own, own * (1 - max(deep)) if len(deep) >= _FEWEST else 0.0
