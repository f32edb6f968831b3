"""CK+ landmarks: ``.txt`` files of 68 lines ``x y``, in folders by subject and sequence."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from facegen.documents import read_text
from facegen.formats.litter import is_litter
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames, of_folders, stacked

_ENDING = "_landmarks.txt"

_MOST_BYTES = 64 * 1024
"""Of one face: 16 times what CK+ writes."""


def is_ck_plus(path: Path) -> bool:
    """Whether this is such a file, or a folder that holds some at any depth."""
    if path.is_dir():
        return next(_files(path), None) is not None
    return path.name.endswith(_ENDING)


def read_ck_plus(path: Path) -> Frames:
    """Faces in the order of subject, sequence and frame; ``S005_001_00000011`` is what a frame is called.

    A sequence goes from neutral to the peak of an expression, and is a take of its own: ``--neutral first`` is for it.
    """
    files = sorted(_files(path)) if path.is_dir() else [path]
    labels = tuple(file.name.removesuffix(_ENDING) for file in files)
    points, _ = stacked(map(_face, files), path)
    folders = [file.parent.relative_to(path).as_posix() if path.is_dir() else "" for file in files]
    return of_folders(Frames(points=points, labels=labels, time_s=None, source=str(path)), folders)


def _files(folder: Path) -> Iterator[Path]:
    return (file for file in folder.rglob(f"*{_ENDING}") if not is_litter(file.name))


def _face(path: Path) -> np.ndarray:
    lines = [line for line in read_text(path, most_bytes=_MOST_BYTES).splitlines() if line.strip()]
    try:
        points = np.loadtxt(lines, dtype=np.float64, ndmin=2) if lines else np.empty((0, 0))
    except ValueError as error:
        raise InputError(f"{path} holds something that is not a number ({error})") from error
    if points.shape != (LANDMARK_COUNT, 2):
        raise InputError(
            f"{path} holds {points.shape[0]} lines of {points.shape[-1]}; 68 lines x y are needed"
        )
    return points
