"""Recordings of several cameras laid side by side, frame by frame."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.pictures.faults import Fault, FrozenWatch, fault_sentences
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.recordings.matching import match
from regress.runtime.headset.recordings.moments import Moments
from regress.runtime.headset.recordings.recording import Recording
from regress.runtime.sample import Sample
from regress.runtime.stages.frame_clock import FrameClock


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

    ``match`` says which frames go together.

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
        Frames a second, whatever films say; without it films and names that are times tell them, or nothing does.

    Raises
    ------
    InputError
        Where there is no recording, the cameras have nothing in common, or no picture is usable.
    """
    if not recordings:
        raise InputError(f"no camera is given; the model has {', '.join(sizes)}")
    own = [recording.note for recording in recordings.values() if recording.note]
    notes = [note for each in recordings.values() for note in _scaling_note(each, sizes, still=still)]
    matched = match(recordings, from_start=from_start, still=still, fps=fps)
    notes += matched.notes
    numbers, count = matched.numbers, len(matched.numbers)
    pictures, faults, scaled_from = {}, {}, {}
    for name, (width, height) in sizes.items():
        found = np.full(count, Fault.MISSING, dtype=object)
        faults[name] = found
        if name not in recordings:
            pictures[name] = np.zeros((count, height, width), dtype=np.uint8)
            continue
        recording, rows = recordings[name], matched.rows[name]
        there = rows >= 0
        if len(rows) == len(recording.pictures) and there.all() and (np.diff(rows) == 1).all():
            pictures[name] = recording.pictures  # as they are: long takes fill the memory
        else:
            pictures[name] = np.where(there[:, None, None], recording.pictures[rows], np.uint8(0))
        found[there] = np.array(recording.faults, dtype=object)[rows[there]]
        if recording.scaled_from is not None:
            scaled_from[name] = np.where(there[:, None], recording.scaled_from[rows], (width, height))
    if not still:
        seen = {name: pictures[name] for name in recordings}
        _mark_frozen(seen, faults, matched)
        pictures |= seen
    found_out = []
    for name in sizes:
        if name in recordings:
            found_out += fault_sentences(name, numbers, faults[name])
        else:
            found_out.append(
                f"{name}: not given; its shapes come from the other cameras as far as these know them"
            )
    source = ", ".join(dict.fromkeys(recording.source for recording in recordings.values()))
    if not any(fault is None for name in sizes for fault in faults[name]):
        # what to do about it stands in recordings' own notes: last, as a terminal is told no long sentence's middle
        raise InputError(f"{source}: no picture is usable: {'; '.join([*notes, *found_out, *own])}")
    return Footage(
        cameras=tuple(sizes),
        numbers=numbers,
        pictures=pictures,
        faults={name: tuple(found) for name, found in faults.items()},
        time_s=matched.time_s,
        source=source,
        notes=(*own, *notes, *found_out),
        scaled_from=scaled_from,
        placement={
            name: recording.placement
            for name, recording in recordings.items()
            if recording.placement is not None
        },
    )


def _mark_frozen(pictures: dict[str, np.ndarray], faults: Mapping[str, np.ndarray], matched: Moments) -> None:
    """Find frozen pictures, as a live headset's are found, and blank them."""
    watch, clock = FrozenWatch(), FrameClock()
    held = {name: np.diff(matched.rows[name], prepend=-1) == 0 for name in pictures}
    for row in range(len(matched.numbers)):
        seconds = clock.step(None if matched.time_s is None else float(matched.time_s[row]))
        sound = {name: stack[row] for name, stack in pictures.items() if faults[name][row] is None}
        for name in watch.step(seconds, sound, held={name for name in sound if held[name][row]}):
            faults[name][row] = Fault.FROZEN
    for name, stack in pictures.items():
        frozen = faults[name] == Fault.FROZEN
        if frozen.any():
            pictures[name] = np.where(frozen[:, None, None], np.uint8(0), stack)


def _scaling_note(recording: Recording, sizes: Mapping[str, tuple[int, int]], *, still: bool) -> list[str]:
    if recording.scaled_from is None or (recording.placement is not None and not recording.whole):
        return []
    wanted, *found = (
        f"{width} x {height}"
        for width, height in dict.fromkeys(
            [sizes[recording.camera], *map(tuple, recording.scaled_from.tolist())]
        )
    )
    if recording.whole and recording.placement is not None and any(recording.placement.cut):
        left, top, right, bottom = (round(100 * share) for share in recording.placement.cut)
        return [
            f"{recording.camera}: its pictures of {', '.join(found)} have bars, which are left out ({left} % at the "
            f"left, {top} % at the top, {right} % at the right, {bottom} % at the bottom); `regress headset check` "
            f"finds a better --placement"
        ]
    if recording.whole:
        return [
            f"{recording.camera}: pictures of {', '.join(found)} have another shape than the network's {wanted}; all "
            f"of each is seen, and `regress headset check` finds a better --placement"
        ]
    # a dataset's renders are of the network's headset, and a take's pictures of any
    hint = "" if still else "; `regress headset check` says whether they lie in them as in training"
    return [f"{recording.camera}: pictures of {', '.join(found)} are scaled to {wanted}{hint}"]
