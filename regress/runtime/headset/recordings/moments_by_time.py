"""Matches frames of several cameras by their times."""

from collections.abc import Mapping

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.recordings.moments import Moments
from regress.runtime.headset.recordings.recording import Recording

_APART = 0.55
"""Of the time from one frame of a camera to the next, by which its frame may differ from the moment it stands for."""


def by_time(recordings: Mapping[str, Recording], called: Mapping[str, Recording]) -> Moments:
    """Moments of the quickest camera, called as its frames in ``called``, and the others' frames next to them.

    Raises
    ------
    InputError
        Where the cameras' times have nothing in common.
    """
    steps_s = {name: _step_s(each) for name, each in recordings.items()}
    quickest = min(recordings, key=lambda name: (steps_s[name], -len(recordings[name].numbers)))
    start_s = max(each.time_s[0] - _APART * steps_s[name] for name, each in recordings.items())
    stop_s = min(each.time_s[-1] + _APART * steps_s[name] for name, each in recordings.items())
    moments = recordings[quickest]
    inside = np.flatnonzero((moments.time_s >= start_s) & (moments.time_s <= stop_s))
    spans = ", ".join(
        f"{name} {each.time_s[0]:.2f}-{each.time_s[-1]:.2f} s" for name, each in recordings.items()
    )
    if not len(inside):
        raise InputError(
            f"the cameras' times have nothing in common ({spans}); --from-start matches takes of different recordings"
        )
    time_s = moments.time_s[inside]
    rows = {}
    for name, each in recordings.items():
        nearest = np.clip(np.searchsorted(each.time_s, time_s), 1, max(1, len(each.time_s) - 1))
        before = np.minimum(nearest - 1, len(each.time_s) - 1)
        nearest = np.minimum(nearest, len(each.time_s) - 1)
        near = np.where(time_s - each.time_s[before] <= each.time_s[nearest] - time_s, before, nearest)
        far = np.abs(each.time_s[near] - time_s) > _APART * max(steps_s[name], steps_s[quickest])
        rows[name] = np.where(far, -1, near)
    beyond_s = {name: 1.1 * max(step_s, steps_s[quickest]) for name, step_s in steps_s.items()}
    whole = all(
        each.time_s[0] > time_s[0] - beyond_s[name] and each.time_s[-1] < time_s[-1] + beyond_s[name]
        for name, each in recordings.items()
    )
    notes = () if whole else (f"the cameras' times differ ({spans}); what they share counts",)
    return Moments(
        numbers=called[quickest].numbers[inside], rows=rows, time_s=time_s - time_s[0], notes=notes
    )


def _step_s(recording: Recording) -> float:
    if len(recording.time_s) < 2:
        return 1 / recording.fps if recording.fps else 0.1
    return float(np.median(np.diff(recording.time_s)))
