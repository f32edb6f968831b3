"""Finds the calm frames of a recording of one person, which stand for the person's neutral face."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

_SHARE = 0.25
"""Frames taken for calm: the quarter that shows least, as people's faces rest most of the time."""

_FEWEST = 8
"""Calm frames below which nothing is certain; ten are what the literature averages."""


@dataclass(frozen=True, kw_only=True)
class CalmFrames:
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


def calm_frames(
    activity: np.ndarray,
    usable: np.ndarray,
    *,
    difference: Callable[[np.ndarray, np.ndarray], float],
    agreement: float,
) -> CalmFrames:
    """Take the calmest quarter of a recording's usable frames, and compare its early half with its late half.

    A detector's bias or a person's looks shift the activity of all frames alike and leave their order. Someone who
    smiles throughout is taken for neutral: a frame named by a person is better than an estimate.

    Parameters
    ----------
    activity : (u,) float
        Sum of the weights of each usable frame, from networks that see the frame alone.
    usable : (u,) int64
        Numbers of the usable frames, in the order of time, at least one.
    difference
        Difference of weights between two sets of frames, given by their numbers.
    agreement
        Largest difference that counts as the same face.
    """
    count = max(1, round(_SHARE * len(usable)))
    frames = usable[np.sort(np.argsort(activity, kind="stable")[:count])]
    if count < _FEWEST:
        reason = f"{len(usable)} frames are usable, and {int(_FEWEST / _SHARE)} are needed"
        return CalmFrames(frames=frames, sure=False, reason=reason)
    between = difference(*np.array_split(frames, 2))
    if between > agreement:
        reason = f"early and late calm frames differ by weights of {between:.2f}, and {agreement} is allowed"
        return CalmFrames(frames=frames, sure=False, reason=reason)
    reason = f"{count} calm frames of {len(usable)} agree to {between:.2f}"
    return CalmFrames(frames=frames, sure=True, reason=reason)
