"""Reads and writes iBUG ``.pts`` files: one face's points, counted from 1 in the file and from 0 here.

::

    version: 1
    n_points: 68
    {
    357.417253 308.455774
    ...
    }

What stands behind ``#`` or ``//`` is a comment.
"""

import os
import re
from pathlib import Path

import numpy as np

from facegen.documents import read_text
from facegen.errors import FormatError

MOST_BYTES = 16 * 1024**2
"""Of one file, half a million points: a face has 68, the densest meshes some 10,000."""

_HEADER = re.compile(r"version: \d+ n_points: (\d{1,9})")
"""What stands before the braces, with one blank where the file has any number of them or line ends."""

_COMMENT = re.compile(r"(?:#|//).*")


def read_pts(path: str | os.PathLike[str]) -> np.ndarray:
    """Read the points of one face.

    Parameters
    ----------
    path
        A ``.pts`` file; its coordinates count from 1, as MATLAB's do.

    Returns
    -------
    (n, 2) float64
        Pixels; (0, 0) is the centre of the top-left pixel.

    Raises
    ------
    FormatError
        Where the file is not a ``.pts`` file, or holds another number of points than it says.
    """
    path = Path(path)
    text = _COMMENT.sub("", read_text(path, most_bytes=MOST_BYTES))
    head, brace, rest = text.partition("{")
    body, end, after = rest.rpartition("}")
    match = _HEADER.fullmatch(" ".join(head.replace(":", ": ").split()))
    if match is None or not (brace and end) or after.strip():
        raise FormatError(
            f"{path} is not a .pts file: 'version: 1', 'n_points: N' and points in braces are needed"
        )
    count = int(match[1])
    rows = [line.split() for line in body.splitlines() if line.strip()]
    if len(rows) != count:
        raise FormatError(f"{path} says n_points: {count} and holds {len(rows)} points")
    for number, row in enumerate(rows, start=1):
        if len(row) != 2:
            raise FormatError(f"{path}: point {number} is {' '.join(row)!r}; two numbers are needed")
    try:
        points = np.array(rows, dtype=np.float64).reshape(-1, 2)
    except ValueError as error:
        raise FormatError(f"{path}: a coordinate is not a number ({error})") from error
    return points - 1


def write_pts(path: str | os.PathLike[str], points: np.ndarray) -> None:
    """Write the points of one face, six decimals each.

    Parameters
    ----------
    path
        File to write; an existing one is replaced.
    points : (n, 2) float
        Pixels; (0, 0) is the centre of the top-left pixel. The file counts from 1.
    """
    rows = "".join(f"{x:.6f} {y:.6f}\n" for x, y in np.asarray(points, dtype=np.float64) + 1)
    Path(path).write_text(f"version: 1\nn_points: {len(points)}\n{{\n{rows}}}\n", encoding="utf-8")
