"""Half pictures: one camera's pictures that show both eyes side by side, or one above the other."""

import os
from pathlib import Path

import numpy as np

HALVES = ("left", "right", "top", "bottom")
"""Of a picture as it is looked at, named behind a source: ``take/both#left``."""


def split_half(source: str) -> tuple[str, str]:
    """A source without the half that stands behind it, and the half; empty where none does."""
    whole, sign, half = source.rpartition("#")
    return (whole, half) if sign and whole and half in HALVES else (source, "")


def whole_of(path: Path) -> Path:
    """The folder or film of a half."""
    return Path(split_half(os.fspath(path))[0])


def half_of(picture: np.ndarray, half: str) -> np.ndarray:
    """A half of a picture (h, w, ...), or all of it where ``half`` is empty; of an odd side without the middle."""
    if not half:
        return picture
    height, width = picture.shape[:2]
    rows = {"top": slice(height // 2), "bottom": slice(-(height // 2), None)}.get(half, slice(None))
    columns = {"left": slice(width // 2), "right": slice(-(width // 2), None)}.get(half, slice(None))
    return picture[rows, columns]


def half_size(size: tuple[int, int], half: str) -> tuple[int, int]:
    """Width and height of a half of pictures."""
    width, height = size
    return (
        width // 2 if half in ("left", "right") else width,
        height // 2 if half in ("top", "bottom") else height,
    )
