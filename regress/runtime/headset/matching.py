"""Matches the frames of several cameras: by their times, by the numbers in their names, or one by one."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.recordings import Recording

_LONGEST_GRID = 4
"""Frames of an even count for each that is there; numbers farther apart, or not even, are clock times."""

_SHARED = 0.5
"""Share of a camera's numbers that are another's too, below which they do not number the same frames. Of two cameras
that are named by clocks of their own, at 60 a second to the millisecond, 6 in 100 are the same by chance."""

_APART = 0.55
"""Of the time from one frame of a camera to the next, by which its frame may differ from the moment it stands for."""


_SLOWER = 1.5
"""Steps of a camera over those of all, from which it is slow, and its picture stands for several moments."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Matching:
    """Which frames of several cameras go together.

    Parameters
    ----------
    numbers : (n,) int64
        What the moments are called.
    rows : mapping of (n,) int64
        By camera: its frame of each moment, by its place in the recording; -1 where it has none.
    time_s : (n,) float64 or None
        Seconds from the first moment, where known.
    notes
        What a person should be told, a sentence each.
    """

    numbers: np.ndarray
    rows: Mapping[str, np.ndarray]
    time_s: np.ndarray | None
    notes: tuple[str, ...] = ()


def match(
    recordings: Mapping[str, Recording],
    *,
    from_start: bool = False,
    still: bool = False,
    fps: float | None = None,
) -> Matching:
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
    recordings = {name: _timed(each) for name, each in recordings.items()}
    begun = {name: _begun(each) for name, each in recordings.items()} if from_start else recordings
    numbered = any(each.numbered for each in recordings.values())
    timed = all(each.time_s is not None and (fps is None or each.numbered) for each in recordings.values())
    if still or (numbered and (len(recordings) == 1 or _shared(begun) >= _SHARED)):
        matched = _by_number(begun, still=still, fps=fps)
        return _to_the_shortest(matched, begun) if from_start else matched
    if timed:
        return _by_time(begun)
    if numbered and not from_start:
        _refuse_numbers(begun)
    return _one_by_one(recordings, fps)


def _timed(recording: Recording) -> Recording:
    """The recording with times, where its frame rate is known."""
    if recording.time_s is not None or recording.fps is None:
        return recording
    return replace(recording, time_s=recording.numbers / recording.fps)


def _begun(recording: Recording) -> Recording:
    """The recording with its first frame at 0."""
    time_s = None if recording.time_s is None else recording.time_s - recording.time_s[0]
    return replace(recording, numbers=recording.numbers - recording.numbers[0], time_s=time_s)


def _shared(recordings: Mapping[str, Recording]) -> float:
    """Least share of a camera's numbers, within the range of the one that has most, that the latter has too."""
    most = max(recordings.values(), key=lambda each: len(each.numbers)).numbers
    shares = [1.0]
    for each in recordings.values():
        inside = each.numbers[(each.numbers >= most[0]) & (each.numbers <= most[-1])]
        shares.append(float(np.isin(inside, most).mean()) if len(inside) else 0.0)
    return min(shares)


def _refuse_numbers(recordings: Mapping[str, Recording]) -> None:
    ranges = {name: (int(r.numbers[0]), int(r.numbers[-1])) for name, r in recordings.items()}
    if max(start for start, _ in ranges.values()) > min(stop for _, stop in ranges.values()):
        found = ", ".join(f"{name} {start}-{stop}" for name, (start, stop) in ranges.items())
        raise InputError(
            f"the cameras' frame numbers have nothing in common ({found}); --from-start matches takes of different "
            f"recordings"
        )
    raise InputError(
        "few frame numbers of one camera are another's, as where files are called by times of clocks of their own; "
        "--from-start matches first frames"
    )


def _by_number(recordings: Mapping[str, Recording], *, still: bool, fps: float | None) -> Matching:
    numbers = _grid(recordings, still=still)
    step = float(np.median(np.diff(numbers))) if len(numbers) > 1 else 1.0
    rows, clock_s = {}, None
    for name, each in recordings.items():
        rows[name] = np.full(len(numbers), -1)
        rows[name][np.searchsorted(numbers, each.numbers)] = np.arange(len(each.numbers))
        own_step = float(np.median(np.diff(each.numbers))) if len(each.numbers) > 1 else step
        if not still and own_step > _SLOWER * step:
            rows[name] = _held(rows[name], numbers, each.numbers, own_step)
        if each.numbered and each.time_s is not None:
            clock_s = np.interp(numbers, each.numbers, each.time_s)
    rate = fps or _film_rate(recordings)
    time_s = None if rate is None else np.arange(len(numbers)) / rate
    if fps is None and clock_s is not None:
        time_s = clock_s - clock_s[0]
    return Matching(numbers=numbers, rows=rows, time_s=time_s, notes=_counting_note(recordings))


def _held(rows: np.ndarray, numbers: np.ndarray, own: np.ndarray, own_step: float) -> np.ndarray:
    """Rows in which a slow camera's frame stands for all moments until its next one is due."""
    before = np.searchsorted(own, numbers, side="right") - 1
    there = (before >= 0) & (numbers - own[before] < own_step)
    return np.where(rows >= 0, rows, np.where(there, before, -1))


def _grid(recordings: Mapping[str, Recording], *, still: bool) -> np.ndarray:
    """Numbers of all frames, those among them that no camera has too."""
    known = np.unique(np.concatenate([recording.numbers for recording in recordings.values()]))
    if still or len(known) < 3:
        return known
    gaps, counts = np.unique(np.diff(known), return_counts=True)
    step = gaps[np.argmax(counts)]
    frames = (known[-1] - known[0]) // step + 1
    if ((known - known[0]) % step).any() or frames > _LONGEST_GRID * len(known):
        return known
    return np.arange(known[0], known[-1] + 1, step)


def _by_time(recordings: Mapping[str, Recording]) -> Matching:
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
    return Matching(numbers=moments.numbers[inside], rows=rows, time_s=time_s - time_s[0], notes=notes)


def _step_s(recording: Recording) -> float:
    if len(recording.time_s) < 2:
        return 1 / recording.fps if recording.fps else 0.1
    return float(np.median(np.diff(recording.time_s)))


def _counting_note(recordings: Mapping[str, Recording]) -> tuple[str, ...]:
    """Whether films and others that are counted from 0 stand beside numbers that begin elsewhere."""
    counted = [name for name, recording in recordings.items() if not recording.numbered]
    first = min((int(each.numbers[0]) for each in recordings.values() if each.numbered), default=0)
    if not counted or first == 0:
        return ()
    return (
        f"{', '.join(counted)}: counted from 0, while the other cameras' numbers begin at {first}; --from-start "
        f"matches first frames",
    )


def _to_the_shortest(matched: Matching, recordings: Mapping[str, Recording]) -> Matching:
    """Without what comes behind the end of the first camera that ends."""
    last = min(int(each.numbers[-1]) for each in recordings.values())
    kept = matched.numbers <= last
    notes = matched.notes
    if not kept.all():
        lengths = ", ".join(f"{name} has {len(each.numbers)}" for name, each in recordings.items())
        notes = (
            *notes,
            f"the cameras have different numbers of frames ({lengths}); the first {int(kept.sum())} count",
        )
    return Matching(
        numbers=matched.numbers[kept],
        rows={name: rows[kept] for name, rows in matched.rows.items()},
        time_s=None if matched.time_s is None else matched.time_s[kept],
        notes=notes,
    )


def _one_by_one(recordings: Mapping[str, Recording], fps: float | None) -> Matching:
    lengths = {name: len(recording.numbers) for name, recording in recordings.items()}
    shortest = min(lengths.values())
    first = next(iter(recordings.values()))
    same = len(set(lengths.values())) == 1
    told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
    rate = fps or _film_rate(recordings)
    return Matching(
        numbers=first.numbers if same and first.numbered else np.arange(shortest),
        rows={name: np.arange(shortest) for name in recordings},
        time_s=None if rate is None else np.arange(shortest) / rate,
        notes=()
        if same
        else (f"the cameras have different numbers of frames ({told}); the first {shortest} count",),
    )


def _film_rate(recordings: Mapping[str, Recording]) -> float | None:
    return next((recording.fps for recording in recordings.values() if recording.fps is not None), None)
