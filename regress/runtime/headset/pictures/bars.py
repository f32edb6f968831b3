"""Finds bars at the edges of a camera's pictures, as programs put them round pictures of another shape.

A bar is as dark as it is still, in all pictures, and ends in a straight line. A lens's rim is round, and a headset's
dark parts carry a sensor's grain.
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
what a burnt-in time covers. A round rim lets go of few pixels from line to line."""

_SMEARED, _EDGE = 8, 2
"""Lines at a bar's end into which a compressed picture is smeared, a block of JPEG's, and lines beyond that count."""

_NARROWEST, _WIDEST = 0.02, 0.4
"""Of a picture's side."""


def bars_of(pictures: np.ndarray) -> tuple[float, float, float, float]:
    """Shares (left, top, right, bottom) of pictures (n, h, w) uint8 of one camera that are bars; 0 where none is."""
    if len(pictures) < FEWEST_PICTURES:
        return NO_CUT
    dark = pictures.max(axis=0) < _DARK
    changes = np.ptp(pictures, axis=0)
    still = dark & (changes <= np.where(pictures.max(axis=0) < _BLACK, _STILL, 0))
    if dark.all():
        return NO_CUT
    middle = pictures[len(pictures) // 2].astype(np.float32)
    left = top = 0
    bottom, right = dark.shape
    # bars at the sides are none of what bars above and below leave, and the other way round
    for _ in range(2):
        parts = [one[:, left:right] for one in (dark, still, middle)]
        top, bottom = _ended(*parts), len(dark) - _ended(*(part[::-1] for part in parts))
        parts = [one[top:bottom].T for one in (dark, still, middle)]
        left, right = _ended(*parts), dark.shape[1] - _ended(*(part[::-1] for part in parts))
    height, width = dark.shape
    return left / width, top / height, 1 - right / width, 1 - bottom / height


def _ended(dark: np.ndarray, still: np.ndarray, levels: np.ndarray) -> int:
    """How many of the first lines (n, across) are a bar; 0 where none is, or where it does not end in a line."""
    alike = np.abs(levels - np.median(levels, axis=1, keepdims=True)) <= _STILL
    shares, count = (still & alike).mean(axis=1), len(dark)
    lines = _first(shares < _OF_A_BAR)
    smeared = _first(dark.mean(axis=1)[lines:] < _OF_A_BAR)
    end = lines + smeared if smeared <= _SMEARED else lines
    beyond = shares[end : end + _EDGE]
    ends = len(beyond) > 0 and beyond.max() <= _OF_A_PICTURE
    return end if lines > 0 and ends and _NARROWEST <= end / count <= _WIDEST else 0


def _first(found: np.ndarray) -> int:
    """Row of the first that is true; their number where none is."""
    return int(np.argmax(found)) if found.any() else len(found)
