"""iBUG ``.pts`` files: one face each, alone or folders of them in the order of their names."""

import re
import shlex
from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby
from pathlib import Path

import numpy as np

from facegen.formats import read_pts
from facegen.formats.litter import is_litter
from facegen.formats.natural_order import natural_order
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames, of_folders, stacked
from regress.runtime.inputs.orders import COUNTS, COUNTS_SAID, seventy

_PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".webp")
"""Of a folder for which landmarks are still to be found."""

_DIGITS = re.compile(r"(\d+)")

_MOST_DIGITS = 18
"""Of a number that 64 bits hold."""


def is_pts(path: Path) -> bool:
    """Whether this is one ``.pts`` file."""
    return path.suffix.lower() == ".pts"


def read_one(path: Path) -> Frames:
    """One face; its label is the file's name without the ending."""
    points, irises = stacked([_face(path)], path)
    return Frames(points=points, labels=(path.stem,), time_s=None, source=str(path), irises=irises)


def read_folder(path: Path) -> Frames:
    """All ``.pts`` files of a folder and those below it, as 300-W has them; ``frame_2`` before ``frame_10``.

    A face is called by its file's name, with the folders between where there are some. Each folder is a take of its
    own, as 300-VW's films are. A number in the names that counts a film's pictures is theirs, so that those without a
    face take their time.
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
    points, irises = stacked(map(_face, files), path)
    labels = tuple(file.relative_to(path).with_suffix("").as_posix() for file in files)
    folders = [file.parent.relative_to(path).as_posix() for file in files]
    frames = Frames(points=points, labels=labels, time_s=None, source=str(path), irises=irises)
    return of_folders(replace(frames, numbers=_numbers(labels, folders)), folders)


def _numbers(names: Sequence[str], folders: Sequence[str]) -> np.ndarray | None:
    """What names count in each folder, those of a folder behind those of the one before; one picture counts nothing."""
    films = [[names[row] for row in rows] for _, rows in groupby(range(len(names)), key=folders.__getitem__)]
    if all(len(film) == 1 for film in films):
        return None
    numbers: list[np.ndarray] = []
    for film in films:
        counted = _counted(film) if len(film) > 1 else np.zeros(1, dtype=np.int64)
        if counted is None:
            return None
        numbers.append(counted - counted[0] + numbers[-1][-1] + 1 if numbers else counted)
    return np.concatenate(numbers)


def _counted(names: Sequence[str]) -> np.ndarray | None:
    """The one number that differs among names, where it counts: most go up by one, as milliseconds do not."""
    pieces = [_DIGITS.split(name) for name in names]
    if len({len(each) for each in pieces}) > 1:
        return None
    varying = [each for each in zip(*pieces, strict=True) if len(set(each)) > 1]
    if len(varying) != 1 or not all(each.isdecimal() and len(each) <= _MOST_DIGITS for each in varying[0]):
        return None
    numbers = np.array([int(each) for each in varying[0]])
    steps = np.diff(numbers)
    return numbers if steps.min() > 0 and np.median(steps) == 1 else None


def _face(path: Path) -> np.ndarray:
    points = read_pts(path)
    if len(points) not in COUNTS:
        raise InputError(f"{path} holds {len(points)} points; {COUNTS_SAID} can be read")
    return seventy(points)
