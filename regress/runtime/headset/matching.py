"""Matches the frames of several cameras: by their times, by the numbers in their names, or one by one."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.recordings import Recording

_LONGEST_GRID = 4
"""Frames of an even count for each that is there; numbers farther apart, or not even, are clock times."""

_SHARED, _SHARED_TICKS = 0.5, 0.9
"""Share of a camera's numbers that are another's too, below which they do not number the same frames; and of numbers
that are a clock's ticks, which are the same by chance: in 6 of 100 frames of two cameras of 60 a second, named by
milliseconds, and in most where their steps fall on whole ones."""

_APART = 0.55
"""Of the time from one frame of a camera to the next, by which its frame may differ from the moment it stands for."""

_SLOWER, _STANDS = 1.3, 1.6
"""Steps of a camera over those of all, from which it is slow; and for how many of its own its picture stands, as live,
where the next one does not come sooner."""

_WINDOW = 20
"""Frames over which a camera that gives three for four moments, say, gives as many again and again."""

_SAME_SPAN = 1.1
"""Factor between the lengths of takes from which counters of other steps are not one counter."""


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
    timed = all(each.time_s is not None and (fps is None or not each.film) for each in recordings.values())
    clocks = timed and any(not each.film for each in recordings.values())
    if still or _are_numbers(begun, clocks=clocks, from_start=from_start):
        matched = _by_number(begun, still=still, fps=fps)
        matched = _to_the_shortest(matched, begun) if from_start else matched
    elif timed:
        return _by_time(begun, called=recordings)
    elif any(each.numbered for each in recordings.values()) and not from_start:
        raise _no_numbers(begun)
    else:
        return _one_by_one(recordings, fps)
    if not from_start:
        return matched
    # frames keep the numbers of the first camera that has any
    first = next((int(each.numbers[0]) for each in recordings.values() if each.numbered), 0)
    return replace(matched, numbers=matched.numbers + first)


def _are_numbers(recordings: Mapping[str, Recording], *, clocks: bool, from_start: bool) -> bool:
    """Whether names number the same frames of all cameras."""
    if not any(each.numbered for each in recordings.values()) or (clocks and from_start):
        return False
    if len(recordings) == 1:
        return True
    spans = [int(each.numbers[-1] - each.numbers[0]) + 1 for each in recordings.values()]
    steps = [span / len(each.numbers) for span, each in zip(spans, recordings.values(), strict=True)]
    if from_start and max(steps) > _SLOWER * min(steps) and max(spans) > _SAME_SPAN * min(spans):
        return False
    return _shared(recordings) >= (_SHARED_TICKS if clocks else _SHARED)


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
    """Least share of numbers, in the range of a camera and of the one with most, that both have."""
    most = max(recordings.values(), key=lambda each: len(each.numbers)).numbers
    shares = [1.0]
    for each in recordings.values():
        own, others = (
            numbers[(numbers >= max(each.numbers[0], most[0])) & (numbers <= min(each.numbers[-1], most[-1]))]
            for numbers in (each.numbers, most)
        )
        both = len(np.intersect1d(own, others))
        shares.append(both / min(len(own), len(others)) if both else 0.0)
    return min(shares)


def _no_numbers(recordings: Mapping[str, Recording]) -> InputError:
    """What is wrong with numbers of which few are shared."""
    ranges = {name: (int(r.numbers[0]), int(r.numbers[-1])) for name, r in recordings.items()}
    if max(start for start, _ in ranges.values()) > min(stop for _, stop in ranges.values()):
        found = ", ".join(f"{name} {start}-{stop}" for name, (start, stop) in ranges.items())
        return InputError(
            f"the cameras' frame numbers have nothing in common ({found}); --from-start matches takes of different "
            f"recordings"
        )
    return InputError(
        "few frame numbers of one camera are another's, as where files are called by times of clocks of their own; "
        "--from-start matches first frames"
    )


def _by_number(recordings: Mapping[str, Recording], *, still: bool, fps: float | None) -> Matching:
    numbers = _grid(recordings, still=still)
    step, rows = _quickest_step(recordings), {}
    for name, each in recordings.items():
        rows[name] = np.full(len(numbers), -1)
        rows[name][np.searchsorted(numbers, each.numbers)] = np.arange(len(each.numbers))
        own_step = _slow_step(each.numbers, step)
        if not still and own_step > _SLOWER * step:
            rows[name] = _held(numbers, each.numbers, own_step)
    rate = fps or _film_rate(recordings)
    time_s = None if rate is None else np.arange(len(numbers)) / rate
    clock = max(
        (each for each in recordings.values() if each.numbered and each.time_s is not None),
        key=lambda each: len(each.numbers),
        default=None,
    )
    if fps is None and clock is not None and len(clock.numbers) > 1:
        tick_s = (clock.time_s[-1] - clock.time_s[0]) / int(clock.numbers[-1] - clock.numbers[0])
        time_s = (numbers - numbers[0]) * tick_s
    return Matching(numbers=numbers, rows=rows, time_s=time_s, notes=_counting_note(recordings))


def _quickest_step(recordings: Mapping[str, Recording]) -> float:
    """Between numbers of the camera that gives most frames."""
    steps = [np.median(np.diff(each.numbers)) for each in recordings.values() if len(each.numbers) > 1]
    return float(min(steps, default=1.0))


def _slow_step(numbers: np.ndarray, step: float) -> float:
    """From one frame to the next of a camera that gives them evenly; 0 of one that loses some now and then.

    A slow camera has no two moments in a row, or as many in each window of them.
    """
    gaps = np.diff(numbers)
    if len(gaps) < 3:
        return 0.0
    usual = float(gaps[gaps <= np.quantile(gaps, 0.95)].mean())
    if np.quantile(gaps, 0.05) >= 2 * step:
        return usual
    if len(numbers) < 5 * _WINDOW:
        return 0.0
    reach = numbers[_WINDOW:] - numbers[:-_WINDOW]
    return usual if np.quantile(np.abs(reach[_WINDOW:] - reach[:-_WINDOW]), 0.9) <= 2 * step else 0.0


def _held(numbers: np.ndarray, own: np.ndarray, own_step: float) -> np.ndarray:
    """Rows in which a slow camera's frame stands for all moments until its next one."""
    before = np.searchsorted(own, numbers, side="right") - 1
    return np.where((before >= 0) & (numbers - own[before] < _STANDS * own_step), before, -1)


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


def _by_time(recordings: Mapping[str, Recording], called: Mapping[str, Recording]) -> Matching:
    """Moments of the quickest camera, called as its frames in ``called``, and the others' frames next to them."""
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
    return Matching(
        numbers=called[quickest].numbers[inside], rows=rows, time_s=time_s - time_s[0], notes=notes
    )


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
    step = _quickest_step(recordings)
    slow = {name: _slow_step(each.numbers, step) for name, each in recordings.items()}
    end = min(
        each.numbers[-1] + (slow[name] if slow[name] > _SLOWER * step else step)
        for name, each in recordings.items()
    )
    kept = matched.numbers < end
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
