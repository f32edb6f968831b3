"""Recordings of several cameras laid side by side, frame by frame."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.faults import Fault, FrozenWatch, fault_sentences
from regress.runtime.headset.placement import CameraPlacement
from regress.runtime.headset.recordings import Recording
from regress.runtime.sample import Sample
from regress.runtime.stages.frame_clock import USUAL_FPS, FrameClock

_LONGEST_GRID = 4
"""Frames of an even count for each that is there; numbers farther apart, or not even, are clock times."""

_SAME_RATE = 1.01
"""Factor between frame rates that are taken for one: 29.97 and 30."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Footage:
    """n frames of a model's cameras.

    Parameters
    ----------
    cameras
        In the model's order.
    numbers : (n,) int64
        What the frames are called.
    pictures
        (n, h, w) uint8 of each camera; 0 where it is not present.
    faults
        Of each camera in each frame; an absent camera has ``Fault.MISSING`` throughout.
    time_s : (n,) float64 or None
        Seconds from the first frame, where known.
    source
        For people.
    notes
        What a person should be told, a sentence each.
    scaled_from
        (n, 2) width and height of each recorded picture, of cameras of which any was scaled.
    placement
        What of the recorded pictures these are, of cameras of which they are not all.
    """

    cameras: tuple[str, ...]
    numbers: np.ndarray
    pictures: dict[str, np.ndarray]
    faults: dict[str, tuple[Fault | None, ...]]
    time_s: np.ndarray | None
    source: str
    notes: tuple[str, ...]
    scaled_from: dict[str, np.ndarray] = field(default_factory=dict)
    placement: dict[str, CameraPlacement] = field(default_factory=dict)

    @property
    def present(self) -> np.ndarray:
        """(n, cameras) bool: which pictures count."""
        return np.array([[fault is None for fault in self.faults[name]] for name in self.cameras]).T

    @property
    def recorded(self) -> np.ndarray:
        """(cameras,) bool: which cameras have a recording at all, usable or not."""
        return np.array(
            [any(fault is not Fault.MISSING for fault in self.faults[name]) for name in self.cameras]
        )

    def samples(self) -> list[Sample]:
        """The frames one by one, as the stages take them."""
        samples = []
        for row, number in enumerate(self.numbers):
            faults = {name: self.faults[name][row] for name in self.cameras}
            samples.append(
                Sample(
                    label=str(number),
                    time_s=None if self.time_s is None else float(self.time_s[row]),
                    pictures={
                        name: self.pictures[name][row] for name in self.cameras if faults[name] is None
                    },
                    faults={name: fault for name, fault in faults.items() if fault is not None},
                )
            )
        return samples

    @property
    def fps(self) -> float | None:
        """Frames a second, in the median; None where times are not known or there is one frame."""
        if self.time_s is None or len(self.time_s) < 2:
            return None
        return 1 / float(np.median(np.diff(self.time_s)))

    @property
    def given(self) -> np.ndarray:
        """(cameras,) bool: which cameras have any picture that counts."""
        return self.present.any(axis=0)


def line_up(
    recordings: Mapping[str, Recording],
    sizes: Mapping[str, tuple[int, int]],
    *,
    from_start: bool = False,
    still: bool = False,
    fps: float | None = None,
) -> Footage:
    """Match the cameras' frames, find what is wrong in them, and leave out what is.

    Cameras are matched by number, films from 0, and a number that is lacking is a missing picture. Where no camera has
    numbers of its own, or with ``from_start``, they are matched from their first frames on to the end of the shortest.

    Parameters
    ----------
    recordings
        By camera; cameras that are left out are absent throughout.
    sizes
        Width and height of every camera of the model, in its order.
    from_start
        For takes of different recordings.
    still
        For frames that have nothing to do with each other: none is frozen, and no number is lacking between others.
    fps
        Frames a second, whatever films say; without it a film's own, or times are not known.

    Raises
    ------
    InputError
        Where there is no recording, films have other frame rates, numbers have nothing in common, or no picture is
        usable.
    """
    if not recordings:
        raise InputError(f"no camera is given; the model has {', '.join(sizes)}")
    if fps is None:
        _check_rates(recordings)
    notes = [note for recording in recordings.values() for note in _scaling_note(recording, sizes)]
    by_number = any(recording.numbered for recording in recordings.values()) and not from_start
    if by_number:
        numbers = _numbers(recordings, still=still)
        notes += _counting_note(recordings)
    else:
        numbers, told = _from_start(recordings)
        notes += told
    rows = {
        name: (np.searchsorted(numbers, recording.numbers) if by_number else np.arange(len(numbers)))
        for name, recording in recordings.items()
    }
    pictures, faults, scaled_from = {}, {}, {}
    for name, (width, height) in sizes.items():
        pictures[name] = np.zeros((len(numbers), height, width), dtype=np.uint8)
        found = np.full(len(numbers), Fault.MISSING, dtype=object)
        if name in recordings:
            recording, count = recordings[name], len(rows[name])
            pictures[name][rows[name]] = recording.pictures[:count]
            found[rows[name]] = recording.faults[:count]
            if recording.scaled_from is not None:
                scaled_from[name] = np.tile((width, height), (len(numbers), 1))
                scaled_from[name][rows[name]] = recording.scaled_from[:count]
        faults[name] = found
    if not still:
        step_s = FrameClock(fps or _film_rate(recordings) or USUAL_FPS).step(None)
        _mark_frozen({name: pictures[name] for name in recordings}, faults, step_s)
    for name in sizes:
        if name in recordings:
            notes += fault_sentences(name, numbers, faults[name])
        else:
            notes.append(
                f"{name}: not given; its shapes come from the other cameras as far as these know them"
            )
    source = ", ".join(dict.fromkeys(recording.source for recording in recordings.values()))
    if not any(fault is None for name in sizes for fault in faults[name]):
        raise InputError(f"{source}: no picture is usable: {'; '.join(notes)}")
    return Footage(
        cameras=tuple(sizes),
        numbers=numbers,
        pictures=pictures,
        faults={name: tuple(found) for name, found in faults.items()},
        time_s=_times(recordings, len(numbers), fps),
        source=source,
        notes=tuple(notes),
        scaled_from=scaled_from,
        placement={
            name: recording.placement
            for name, recording in recordings.items()
            if recording.placement is not None
        },
    )


def _mark_frozen(pictures: Mapping[str, np.ndarray], faults: Mapping[str, np.ndarray], step_s: float) -> None:
    """Find frozen pictures, as a live headset's are found, and blank them."""
    watch = FrozenWatch()
    for row in range(len(next(iter(pictures.values())))):
        sound = {name: stack[row] for name, stack in pictures.items() if faults[name][row] is None}
        for name in watch.step(step_s, sound):
            faults[name][row] = Fault.FROZEN
    for name, stack in pictures.items():
        stack[faults[name] == Fault.FROZEN] = 0


def _check_rates(recordings: Mapping[str, Recording]) -> None:
    """Refuse films whose frames are not of the same times: they are matched by their numbers."""
    rates = {name: recording.fps for name, recording in recordings.items() if recording.fps is not None}
    if rates and max(rates.values()) > _SAME_RATE * min(rates.values()):
        told = ", ".join(f"{name} has {rate:.4g}" for name, rate in rates.items())
        raise InputError(
            f"the films have different frames a second ({told}); give films of one rate, or --fps to match them frame "
            f"by frame"
        )


def _scaling_note(recording: Recording, sizes: Mapping[str, tuple[int, int]]) -> list[str]:
    if recording.scaled_from is None or recording.placement is not None:
        return []
    wanted, *found = (
        f"{width} x {height}"
        for width, height in dict.fromkeys(
            [sizes[recording.camera], *map(tuple, recording.scaled_from.tolist())]
        )
    )
    return [f"{recording.camera}: pictures of {', '.join(found)} are scaled to {wanted}"]


def _numbers(recordings: Mapping[str, Recording], *, still: bool) -> np.ndarray:
    """Numbers of all frames, those among them that no camera has too."""
    ranges = {name: (int(r.numbers[0]), int(r.numbers[-1])) for name, r in recordings.items()}
    latest_start = max(start for start, _ in ranges.values())
    earliest_stop = min(stop for _, stop in ranges.values())
    if latest_start > earliest_stop:
        found = ", ".join(f"{name} {start}-{stop}" for name, (start, stop) in ranges.items())
        raise InputError(
            f"the cameras' frame numbers have nothing in common ({found}); --from-start matches takes of different "
            f"recordings"
        )
    known, shown = np.unique(
        np.concatenate([recording.numbers for recording in recordings.values()]), return_counts=True
    )
    if not still and len(recordings) > 1 and shown.max() == 1:
        raise InputError(
            "no frame number of one camera is another's, as where files are called by times of clocks of their own; "
            "--from-start matches first frames"
        )
    if still or len(known) < 3:
        return known
    gaps, counts = np.unique(np.diff(known), return_counts=True)
    step = gaps[np.argmax(counts)]
    frames = (known[-1] - known[0]) // step + 1
    if ((known - known[0]) % step).any() or frames > _LONGEST_GRID * len(known):
        return known
    return np.arange(known[0], known[-1] + 1, step)


def _counting_note(recordings: Mapping[str, Recording]) -> list[str]:
    """Whether films and others that are counted from 0 stand beside numbers that begin elsewhere."""
    counted = [name for name, recording in recordings.items() if not recording.numbered]
    first = min(int(recording.numbers[0]) for recording in recordings.values() if recording.numbered)
    if not counted or first == 0:
        return []
    return [
        f"{', '.join(counted)}: counted from 0, while the other cameras' numbers begin at {first}; --from-start "
        f"matches first frames"
    ]


def _from_start(recordings: Mapping[str, Recording]) -> tuple[np.ndarray, list[str]]:
    lengths = {name: len(recording.numbers) for name, recording in recordings.items()}
    shortest = min(lengths.values())
    first = next(iter(recordings.values()))
    if len(set(lengths.values())) == 1:
        return first.numbers if first.numbered else np.arange(shortest), []
    told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
    return np.arange(shortest), [
        f"the cameras have different numbers of frames ({told}); the first {shortest} count"
    ]


def _times(recordings: Mapping[str, Recording], count: int, fps: float | None) -> np.ndarray | None:
    """Seconds of rows, which are even in time: lacking numbers have rows too."""
    fps = fps or _film_rate(recordings)
    return None if fps is None else np.arange(count) / fps


def _film_rate(recordings: Mapping[str, Recording]) -> float | None:
    return next((recording.fps for recording in recordings.values() if recording.fps is not None), None)
