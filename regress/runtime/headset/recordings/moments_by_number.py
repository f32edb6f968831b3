"""Matches frames of several cameras by the numbers in their names."""

from collections.abc import Mapping

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.recordings.moments import Moments
from regress.runtime.headset.recordings.recording import Recording

_LONGEST_GRID = 4
"""Frames of an even count for each that is there; numbers farther apart, or not even, are clock times."""

_SHARED, _SHARED_TICKS = 0.5, 0.9
"""Share of a camera's numbers that are another's too, below which they do not number the same frames; and of numbers
that are a clock's ticks, which are the same by chance: in 6 of 100 frames of two cameras of 60 a second, named by
milliseconds, and in most where their steps fall on whole ones."""

_SLOWER, _STANDS = 1.3, 1.6
"""Steps of a camera over those of all, from which it is slow; and for how many of its own its picture stands, as live,
where the next one does not come sooner."""

_WINDOW = 20
"""Frames over which a camera that gives three for four moments, say, gives as many again and again."""

_SAME_SPAN = 1.1
"""Factor between the lengths of takes from which counters of other steps are not one counter, and from which one that
ends first may be that of a camera with fewer frames a second."""


def are_numbers(recordings: Mapping[str, Recording], *, clocks: bool, from_start: bool) -> bool:
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


def no_numbers(recordings: Mapping[str, Recording]) -> InputError:
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


def by_number(recordings: Mapping[str, Recording], *, still: bool, fps: float | None) -> Moments:
    """Moments of all numbers, those between that no camera has too; a slow camera's picture stands until its next."""
    numbers = _grid(recordings, still=still)
    step, rows = _quickest_step(recordings), {}
    for name, each in recordings.items():
        rows[name] = np.full(len(numbers), -1)
        rows[name][np.searchsorted(numbers, each.numbers)] = np.arange(len(each.numbers))
        own_step = _slow_step(each.numbers, step)
        if not still and own_step > _SLOWER * step:
            rows[name] = _held(numbers, each.numbers, own_step)
    rate = fps or film_rate(recordings)
    time_s = None if rate is None else np.arange(len(numbers)) / rate
    clock = max(
        (each for each in recordings.values() if each.numbered and each.time_s is not None),
        key=lambda each: len(each.numbers),
        default=None,
    )
    if fps is None and clock is not None and len(clock.numbers) > 1:
        tick_s = (clock.time_s[-1] - clock.time_s[0]) / int(clock.numbers[-1] - clock.numbers[0])
        time_s = (numbers - numbers[0]) * tick_s
    return Moments(numbers=numbers, rows=rows, time_s=time_s, notes=_counting_note(recordings))


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


def ending_notes(recordings: Mapping[str, Recording]) -> tuple[str, ...]:
    """Which counters begin as the others do and end long before them: their cameras stopped, or are slow ones.

    A slow camera's frames that were counted by themselves go with a quick one's first ones, later and later.
    """
    first = min(int(each.numbers[0]) for each in recordings.values())
    ends = {name: int(each.numbers[-1]) for name, each in recordings.items() if each.numbers[0] <= first + 1}
    last = max(int(each.numbers[-1]) for each in recordings.values())
    return tuple(
        f"{name}: its numbers end at {end}, while others go on to {last}; if it did not stop there but gives fewer "
        f"frames a second, call all files by their times, as 1700000000.25.png"
        for name, end in ends.items()
        if last - first + 1 > _SAME_SPAN * (end - first + 1)
    )


def to_the_shortest(matched: Moments, recordings: Mapping[str, Recording]) -> Moments:
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
    return Moments(
        numbers=matched.numbers[kept],
        rows={name: rows[kept] for name, rows in matched.rows.items()},
        time_s=None if matched.time_s is None else matched.time_s[kept],
        notes=notes,
    )


def film_rate(recordings: Mapping[str, Recording]) -> float | None:
    """Frames a second, as the first film says; None where none does."""
    return next((recording.fps for recording in recordings.values() if recording.fps is not None), None)
