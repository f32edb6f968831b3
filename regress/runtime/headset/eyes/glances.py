"""Reads what an eye says while it looks at a target: over a moment about a frame, for that frame may be of a blink."""

from collections.abc import Sequence

import numpy as np

_MOMENT_S = 0.15
"""Before and behind a target's frame: people look at a thing for longer than both together."""

_STILL_DEG = 3.0
"""By which an answer changes at most while an eye rests; frames of another look differ by more."""

_OPEN, _SHUT = 0.5, 0.25
"""Openness, against the widest of the moment, from which a pupil is to be seen; below the other, as a share of the own,
an eye is shut for all of it. Eyes that look 12 degrees down are half as wide as others, or less before some cameras."""


def glances(
    answers: Sequence[np.ndarray], openness: np.ndarray, time_s: np.ndarray, rows: Sequence[int]
) -> list[np.ndarray]:
    """Each answer (k, 2) in degrees at k targets; NaN where the eye was shut or away.

    Parameters
    ----------
    answers
        Each (n, 2) in degrees; NaN where the eye is not seen.
    openness : (n,)
        As a share of the person's own.
    time_s : (n,)
        Of the frames.
    rows
        Of the frames that targets are given for.
    """
    found = [np.full((len(rows), 2), np.nan) for _ in answers]
    seen = np.isfinite(openness) & np.isfinite(answers).all(axis=(0, 2))
    for place, row in enumerate(rows):
        off_s = np.abs(time_s - time_s[row])
        others = [other for other in rows if other != row]
        of_others = (np.abs(time_s[:, None] - time_s[others]) <= off_s[:, None]).any(axis=1)
        moment = seen & (off_s <= _MOMENT_S + 1e-6) & ~of_others
        widest = openness[moment].max(initial=0.0)
        if widest < _SHUT:
            continue
        moment &= openness >= _OPEN * widest
        if moment[row]:
            far = [np.abs(answer - answer[row]).max(axis=1) > _STILL_DEG for answer in answers]
            moment &= ~np.any(far, axis=0)
        for one, answer in zip(found, answers, strict=True):
            one[place] = np.median(answer[moment], axis=0)
    return found
