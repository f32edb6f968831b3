"""Matches the frames of several cameras: by their times, by the numbers in their names, or one by one."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from regress.runtime.headset.recordings.moments import Moments
from regress.runtime.headset.recordings.moments_by_number import (
    are_numbers,
    by_number,
    ending_notes,
    film_rate,
    no_numbers,
    to_the_shortest,
)
from regress.runtime.headset.recordings.moments_by_time import by_time
from regress.runtime.headset.recordings.recording import Recording


def match(
    recordings: Mapping[str, Recording],
    *,
    from_start: bool = False,
    still: bool = False,
    fps: float | None = None,
) -> Moments:
    """Match cameras by numbers in names, by the times of films and clocks, or from their first frames on.

    Where most numbers of a camera are another's too they count, and a number that is lacking is a missing picture;
    films count from 0 beside them. Else the quickest camera's frames are the moments, and the others' nearest ones go
    with them; times of films do not count where ``fps`` is given. A slow camera's picture stands for several moments.
    Without either, frames are matched one by one, to the end of the shortest camera.

    Parameters
    ----------
    recordings
        By camera; one at least.
    from_start
        Let each begin at 0: takes of different recordings.
    still
        Frames have nothing to do with each other: no number is lacking between others.
    fps
        Frames a second, whatever films say.

    Raises
    ------
    InputError
        Where the cameras have nothing in common.
    """
    recordings = _on_one_clock({name: _timed(each) for name, each in recordings.items()})
    begun = {name: _begun(each) for name, each in recordings.items()} if from_start else recordings
    timed = all(each.time_s is not None and (fps is None or not each.film) for each in recordings.values())
    clocks = timed and any(not each.film for each in recordings.values())
    if still or are_numbers(begun, clocks=clocks, from_start=from_start):
        matched = by_number(begun, still=still, fps=fps)
        matched = to_the_shortest(matched, begun) if from_start else matched
    elif timed:
        return by_time(begun, called=recordings)
    elif any(each.numbered for each in recordings.values()) and not from_start:
        raise no_numbers(begun)
    else:
        return _one_by_one(recordings, fps)
    if not from_start:
        return matched if still else replace(matched, notes=matched.notes + ending_notes(begun))
    # frames keep the numbers of the first camera that has any
    first = next((int(each.numbers[0]) for each in recordings.values() if each.numbered), 0)
    return replace(matched, numbers=matched.numbers + first)


def _timed(recording: Recording) -> Recording:
    """The recording with times, where its frame rate is known."""
    if recording.time_s is not None or recording.fps is None:
        return recording
    return replace(recording, time_s=recording.numbers / recording.fps)


def _on_one_clock(recordings: dict[str, Recording]) -> dict[str, Recording]:
    """The recordings, whose films with times of a clock begin at 0 where not all have some.

    Names of pictures tell times of a clock too, which may be another one.
    """
    if all(each.clock for each in recordings.values()):
        return recordings
    named = all(each.clock or (not each.film and each.time_s is not None) for each in recordings.values())
    if named and _share_time(recordings):
        return recordings
    return {
        name: replace(each, time_s=each.time_s - each.time_s[0]) if each.clock else each
        for name, each in recordings.items()
    }


def _share_time(recordings: Mapping[str, Recording]) -> bool:
    """Whether there is a time at which all record."""
    first_s = max(each.time_s[0] for each in recordings.values())
    return bool(first_s <= min(each.time_s[-1] for each in recordings.values()))


def _begun(recording: Recording) -> Recording:
    """The recording with its first frame at 0."""
    time_s = None if recording.time_s is None else recording.time_s - recording.time_s[0]
    return replace(recording, numbers=recording.numbers - recording.numbers[0], time_s=time_s)


def _one_by_one(recordings: Mapping[str, Recording], fps: float | None) -> Moments:
    lengths = {name: len(recording.numbers) for name, recording in recordings.items()}
    shortest = min(lengths.values())
    first = next(iter(recordings.values()))
    same = len(set(lengths.values())) == 1
    told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
    rate = fps or film_rate(recordings)
    return Moments(
        numbers=first.numbers if same and first.numbered else np.arange(shortest),
        rows={name: np.arange(shortest) for name in recordings},
        time_s=None if rate is None else np.arange(shortest) / rate,
        notes=()
        if same
        else (f"the cameras have different numbers of frames ({told}); the first {shortest} count",),
    )
