"""iBUG ``.pts`` files: one face each, alone or folders of them in the order of their names."""

import shlex
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from facegen.formats import read_pts
from facegen.formats.litter import is_litter
from facegen.formats.natural_order import natural_order
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames, stacked

_PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".webp")
"""Of a folder for which landmarks are still to be found."""


def is_pts(path: Path) -> bool:
    """Whether this is one ``.pts`` file."""
    return path.suffix.lower() == ".pts"


def read_one(path: Path) -> Frames:
    """One face; its label is the file's name without the ending."""
    return Frames(points=_face(path)[None], labels=(path.stem,), time_s=None, source=str(path))


def read_folder(path: Path) -> Frames:
    """All ``.pts`` files of a folder and those below it, as 300-W has them; ``frame_2`` before ``frame_10``.

    A face is called by its file's name, with the folders between where there are some.
    """
    files = sorted(
        (file for file in path.rglob("*") if is_pts(file) and not is_litter(file.name)),
        key=lambda file: natural_order(file.relative_to(path).as_posix()),
    )
    if not files:
        if any(file.suffix.lower() in _PICTURES for file in path.iterdir()):
            raise InputError(
                f"{path} holds pictures and no .pts file; track --fast --no-page --camera {shlex.quote(str(path))} "
                "--record weights.csv finds landmarks itself, and regress headset predict reads a headset's cameras"
            )
        raise InputError(f"{path} holds no .pts file")
    points = stacked(map(_face, files), path)
    labels = tuple(file.relative_to(path).with_suffix("").as_posix() for file in files)
    return Frames(points=points, labels=labels, time_s=None, source=str(path))


def _face(path: Path) -> np.ndarray:
    points = read_pts(path)
    if len(points) != LANDMARK_COUNT:
        raise InputError(f"{path} holds {len(points)} points; the iBUG order of {LANDMARK_COUNT} is needed")
    return points
