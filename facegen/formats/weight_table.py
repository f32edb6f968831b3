"""Reads blendshape weights over time: Live Link Face recordings, or any CSV with the 52 ARKit columns."""

import os
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES
from facegen.errors import FormatError
from facegen.formats.csv_rows import CsvRows, numbers_in
from facegen.formats.live_link import take_of_rows

DEFAULT_FPS = 30.0
"""Rows a second where neither the file nor the reader says."""


def read_weight_table(
    path: str | os.PathLike[str], *, fps: float | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Read weights and times of a CSV.

    Parameters
    ----------
    path
        A Live Link Face recording, or a CSV with a column for each ARKit name, with or without a capital, and maybe
        ``time_s``, such as ``regress predict`` writes.
    fps
        Rows a second; without it the file's own times count, or `DEFAULT_FPS` where it has none.

    Returns
    -------
    weights : (n, 52) float64
        In ``BLENDSHAPES`` order; rows of empty cells, frames without a face, are NaN.
    time_s : (n,) float64
        Seconds from the first row.

    Raises
    ------
    FormatError
        Where the file cannot be read, a blendshape's column is missing, there are no rows, or a cell is no number.
    """
    path = Path(path)
    with CsvRows(path) as table:
        columns = {name.lower(): column for name, column in table.columns.items()}
        if "timecode" in columns:
            take = take_of_rows(table, fps=fps)
            return take.weights, take.time_s
        missing = [name for name in BLENDSHAPES if name.lower() not in columns]
        if missing:
            raise FormatError(
                f"{path}: column {missing[0]} is missing ({len(missing)} of the 52 ARKit columns are)"
            )
        names = [*BLENDSHAPES, *(["time_s"] if "time_s" in columns else [])]
        picked = [columns[name.lower()] for name in names]
        try:
            values = np.array([numbers_in(row, picked) for row in table])
        except ValueError as error:
            raise FormatError(f"{path}: a cell is no number ({error})") from error
    weights = values[:, : len(BLENDSHAPES)]
    if fps is None and "time_s" in columns:
        time_s = filled_times(values[:, -1])
        return weights, time_s - time_s[0]
    return weights, np.arange(len(values)) / (fps or DEFAULT_FPS)


def filled_times(time_s: np.ndarray) -> np.ndarray:
    """Times of which an unknown one is that of the row before, or the first known one; zeros where none is known."""
    known = np.flatnonzero(np.isfinite(time_s))
    last = np.searchsorted(known, np.arange(len(time_s)), side="right") - 1
    return time_s[known[np.maximum(last, 0)]] if len(known) else np.zeros(len(time_s))
