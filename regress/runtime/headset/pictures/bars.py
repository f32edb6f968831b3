"""Finds bars at the edges of a camera's pictures, as programs put them round pictures of another shape.

A bar is as dark as it is still, in all pictures, and ends at once, in a straight line along the picture's edge. A
lens's rim is round and soft, a headset's edges are slanted, and its dark parts carry a sensor's grain. What may be
either is none: a bar that is seen costs less than a face that is cut.
"""

import numpy as np

from regress.runtime.headset.pictures.placement import NO_CUT

FEWEST_PICTURES = 8
"""Of a camera: in fewer a dark part that seldom moves would be a bar."""

LOOKED_AT = 12
"""Pictures, all over a take, or a live camera's first ones."""

_DARK = 32
"""Grey level that bars stay below: black films have 0 or 16, and what compression adds at an edge."""

_BLACK, _STILL = 6, 1.0
"""Grey level below which a bar's pixel may change over all pictures by the other, as compression has it; brighter ones
may not at all. Rendered headsets' dark parts have 12 and more, and a good sensor's grain."""

_OF_A_BAR, _OF_A_PICTURE = 0.6, 0.3
"""Share of a line's pixels that are a bar's, at least, and at most of the line where the picture begins: between lies
what a burnt-in time covers."""

_SMEARED, _EDGE = 8, 2
"""Lines at a bar's end into which a compressed picture is smeared, a block of JPEG's, and lines beyond that count."""

_PARTS, _REACH = 3, 4
"""Of a line, whose ends are sought by themselves, and lines to both sides of the end in which they are sought."""

_ALL_ALONG = 0.9
"""Share of a line's pixels from which all of it is a bar's, with a burnt-in time."""

_APART = 0.75
"""Lines that the ends of a bar's parts lie apart at most: an edge that is turned by one degree has 1.1 in pictures 96
pixels wide, and a round rim far more."""

_NARROWEST, _WIDEST = 0.02, 0.4
"""Of a picture's side."""


def bars_of(pictures: np.ndarray) -> tuple[float, float, float, float]:
    """Shares (left, top, right, bottom) of pictures (n, h, w) uint8 of one camera that are bars; 0 where none is."""
    if len(pictures) < FEWEST_PICTURES:
        return NO_CUT
    brightest = pictures.max(axis=0)
    dark = brightest < _DARK
    still = dark & (np.ptp(pictures, axis=0) <= np.where(brightest < _BLACK, _STILL, 0))
    if dark.all():
        return NO_CUT
    middle = pictures[len(pictures) // 2].astype(np.float32)
    mean = pictures.mean(axis=0, dtype=np.float32)
    left = top = 0
    bottom, right = dark.shape
    # bars at the sides are none of what bars above and below leave, and the other way round
    for _ in range(2):
        parts = [one[:, left:right] for one in (dark, still, middle, mean)]
        top, bottom = _ended(*parts), len(dark) - _ended(*(part[::-1] for part in parts))
        parts = [one[top:bottom].T for one in (dark, still, middle, mean)]
        left, right = _ended(*parts), dark.shape[1] - _ended(*(part[::-1] for part in parts))
    height, width = dark.shape
    return left / width, top / height, 1 - right / width, 1 - bottom / height


def _ended(dark: np.ndarray, still: np.ndarray, levels: np.ndarray, mean: np.ndarray) -> int:
    """How many of the first lines (n, across) are a bar; 0 where none is, or where it does not end in a line."""
    of_bar = still & (np.abs(levels - np.median(levels[0])) <= _STILL)
    lines = _first(of_bar.mean(axis=1) < _OF_A_BAR)
    if _ends_in_a_line(of_bar, lines, of_bar):
        return lines
    smeared = _first(dark.mean(axis=1)[lines:] < _OF_A_BAR)
    end = lines + smeared
    if lines == 0 or not 0 < smeared <= _SMEARED:
        return 0
    # a rim fades, so that its last dark line is brighter than its first one
    fades = np.median(mean[end - 1]) - np.median(mean[0]) > _BLACK
    return end if not fades and _ends_in_a_line(dark, end, of_bar) else 0


def _ends_in_a_line(dark: np.ndarray, end: int, of_bar: np.ndarray) -> bool:
    """Whether dark pixels (n, across) end there in all parts of the line, and the lines behind it are none of a bar."""
    if not _NARROWEST <= end / len(dark) <= _WIDEST:
        return False
    across = of_bar.mean(axis=0) < _ALL_ALONG  # without bars at the sides, which go on behind it
    if across.sum() < _PARTS or of_bar[end : end + _EDGE, across].mean(axis=1).max() > _OF_A_PICTURE:
        return False
    found = dark[max(0, end - _REACH) : end + _REACH, across].sum(axis=0)
    ends = []
    for part in np.array_split(found, _PARTS):
        middle = np.sort(part)[
            len(part) // 4 : len(part) - len(part) // 4
        ]  # without a burnt-in time's columns
        ends.append(middle.mean())
    return bool(max(ends) - min(ends) <= _APART)


def _first(found: np.ndarray) -> int:
    """Row of the first that is true; their number where none is."""
    return int(np.argmax(found)) if found.any() else len(found)
