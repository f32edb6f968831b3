"""What is wrong with a camera's pictures: none, unreadable, of another shape, black, of one grey, frozen."""

from collections.abc import Collection, Mapping, Sequence
from enum import Enum

import cv2
import numpy as np

from facegen.number_ranges import format_ranges

DARK = 24
"""Grey level that the brightest fiftieth of a black picture stays below.

Rendered views have 124 and more there (41 samples of `tracking3`, black level 8); a lens cap and sensor noise have less
than 20. An eye in a tenth of its light has less as well, so that a dark picture is looked at again.
"""

_BRIGHT_SHARE = 0.02
"""Of a picture's pixels; counting them takes a twentieth of the time of a percentile."""

FLAT = 4.0
"""Standard deviation in grey levels below which a picture may show nothing; rendered views have 32 and more."""

_SHAPES = 4.0
"""How many times the range of a picture's shapes is that of its grain, if it shows something.

A lens cap with a sensor's noise has 0.8 to 0.9, whatever the noise; films of real eyes in a tenth of their light 12.
"""

_LEAST_SHAPES = 4.0
"""Grey levels of shapes at least; those films have 4.9 and 9.8, a cap with a glow of 12 grey levels 3."""

_GRAIN_PX = 1.5
"""Blur that leaves no grain."""

_GLOW = 1 / 8
"""Blur that leaves a lens's glow and vignette alone, as a share of the picture's width."""

STILL = 0.1
"""Mean difference in grey levels up to which two pictures are the same one.

Sensor noise alone makes more than 1; a film's encoder leaves less than this between repeats of one picture.
"""

FROZEN_S = 0.27
"""Seconds for which a picture may stay the same while other cameras go on; a camera whose picture stays is frozen.

Of a camera with four pictures a second each one stands for as long beside those of quicker cameras. What is read from
a file is judged as it would be live, so the repeats before count as pictures.
"""

_TOLD_RUNS = 8
"""Runs of frames that a sentence lists; the count in front of them is of all."""

RESHAPE = (
    "`regress headset check` finds a placement for pictures of any shape, and a camera that shows both eyes is named "
    "by its halves (left_eye=0#left)"
)
"""What helps against `Fault.SHAPE`."""


class Fault(Enum):
    """What is wrong with a camera in a frame; the value says what it has there."""

    MISSING = "no picture"
    UNREADABLE = "a file that is no picture"
    LARGE = "a file or picture that is too large"
    SHAPE = "a picture of another shape"
    BLACK = "a black picture"
    FLAT = "a picture of one grey"
    FROZEN = "the picture of before again, while other cameras go on"


def is_black(picture: np.ndarray) -> bool:
    """Whether no fiftieth of a picture's numbers (h, w, ...) uint8 reaches `DARK`, and nothing shows in it."""
    dark = np.count_nonzero(picture >= DARK) < _BRIGHT_SHARE * picture.size
    return dark and not _shows_shapes(picture)


def picture_fault(picture: np.ndarray) -> Fault | None:
    """What is wrong with a picture (h, w) uint8 by itself."""
    if is_black(picture):
        return Fault.BLACK
    _, deviation = cv2.meanStdDev(picture)
    return Fault.FLAT if deviation[0, 0] < FLAT and not _shows_shapes(picture) else None


def _shows_shapes(picture: np.ndarray) -> bool:
    """Whether something between grain and a glow is in a picture that is dark, or nearly of one grey."""
    values = picture.astype(np.float32)
    if values.ndim == 3:  # a tint is no shape
        values = values.mean(axis=2)
    coarse = cv2.GaussianBlur(values, (0, 0), _GRAIN_PX)
    shapes = coarse - cv2.GaussianBlur(coarse, (0, 0), _GLOW * values.shape[1])
    low, high = np.percentile(shapes, [2, 98])
    return high - low >= max(_LEAST_SHAPES, _SHAPES * float((values - coarse).std()))


class FrozenWatch:
    """Watches cameras side by side for one that repeats a picture while another moves, as frames come.

    A camera is frozen once its picture has stayed longer than `FROZEN_S`, if another one has changed since then. A
    recording of one camera has no others, and is never called frozen.
    """

    def __init__(self) -> None:
        self._first: dict[str, np.ndarray] = {}
        self._still_s: dict[str, float] = {}
        self._held_s: dict[str, float] = {}
        self._moved: set[str] = set()

    def step(
        self, seconds: float, pictures: Mapping[str, np.ndarray], *, held: Collection[str] = ()
    ) -> set[str]:
        """Names of the cameras whose picture is frozen in the next frame.

        Parameters
        ----------
        seconds
            Since the frame before.
        pictures
            (h, w) uint8 by camera; a camera without a picture starts afresh.
        held
            Cameras that gave no picture for this frame: a slow one's is that of before.
        """
        self._first = {name: first for name, first in self._first.items() if name in pictures}
        changed = set()
        for name, picture in pictures.items():
            # compared with the first of a run, so that slow drift is no repeat
            if name in self._first and _same(self._first[name], picture):
                # what a slow camera's picture stood for counts once its next one is the same
                self._held_s[name] += seconds
                if name not in held:
                    self._still_s[name] += self._held_s[name]
                    self._held_s[name] = 0.0
            else:
                # a copy: programs fill one buffer again and again
                self._first[name], self._still_s[name], self._held_s[name] = picture.copy(), 0.0, 0.0
                self._moved.discard(name)
                changed.add(name)
        self._moved |= {name for name in pictures if name not in changed and changed}
        return {name for name in pictures if self._still_s[name] > FROZEN_S and name in self._moved}


def fault_sentences(camera: str, numbers: Sequence[int], faults: Sequence[Fault | None]) -> list[str]:
    """A sentence a kind of fault: how many of a camera's frames, and which, by their numbers."""
    lines = []
    for fault in Fault:
        frames = [int(number) for number, other in zip(numbers, faults, strict=True) if other is fault]
        if frames:
            if len(frames) < len(faults):
                said = f"{len(frames)} of {len(faults)} frames have {fault.value}: {_listed(frames)}"
            else:
                cure = f"; {RESHAPE}" if fault is Fault.SHAPE else ""
                said = f"all of its {len(faults)} frames have {fault.value}{cure}"
            lines.append(f"{camera}: {said}")
    return lines


def _listed(frames: list[int]) -> str:
    runs = format_ranges(frames).split(",")
    if len(runs) <= _TOLD_RUNS:
        return ", ".join(runs)
    return f"{', '.join(runs[:_TOLD_RUNS])} and {len(runs) - _TOLD_RUNS} more"


def _same(one: np.ndarray, other: np.ndarray) -> bool:
    return cv2.norm(one, other, cv2.NORM_L1) <= STILL * one.size
