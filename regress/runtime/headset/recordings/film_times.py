"""Reads the times of a film's frames that stand in a file beside it, as Pupil's programs write them.

``eye0.mp4`` has ``eye0_timestamps.npy``, or ``eye0_timestamps.csv`` with a column of times. A film's own times begin
with its first frame; those beside it are of one clock for all cameras.
"""

import csv
from pathlib import Path

import numpy as np

from facegen.archives import load_npy
from facegen.documents import read_text
from regress.errors import InputError

MOST_TIMES_BYTES = 64 * 1024**2
"""Of a file of times: two million rows of a CSV."""

_UNITS = {"ns": 1e-9, "us": 1e-6, "µs": 1e-6, "ms": 1e-3}
"""In brackets behind a column's name; seconds otherwise."""


def times_beside(film: Path, count: int) -> tuple[np.ndarray | None, str]:
    """Seconds (count,) of a film's frames from the file beside it, and what to say of that file; None without one.

    A file of another number of times, or of times that do not rise, is told and does not count.
    """
    for suffix, read in ((".npy", _of_array), (".csv", _of_table)):
        path = film.with_name(f"{film.stem}_timestamps{suffix}")
        if not path.is_file():
            continue
        try:
            time_s = read(path)
        except (InputError, ValueError) as error:
            return None, f"{path.name} does not count: {error}"
        if len(time_s) != count:
            return (
                None,
                f"{path.name} does not count: it has {len(time_s)} times, and the film {count} frames",
            )
        if not (np.isfinite(time_s).all() and (np.diff(time_s) > 0).all()):
            return None, f"{path.name} does not count: its times do not rise"
        return time_s, f"its frames' times are those of {path.name}"
    return None, ""


def _of_array(path: Path) -> np.ndarray:
    found = load_npy(path, most_bytes=MOST_TIMES_BYTES)
    if found.dtype.kind not in "iuf":
        raise ValueError("it holds no numbers")
    return found.astype(np.float64).ravel()


def _of_table(path: Path) -> np.ndarray:
    """The first column whose name has "timestamp" in it."""
    rows = list(csv.reader(read_text(path, most_bytes=MOST_TIMES_BYTES).splitlines()))
    names = [name.strip().lower() for name in rows[0]] if rows else []
    column = next((place for place, name in enumerate(names) if "timestamp" in name), None)
    if column is None:
        raise ValueError("none of its columns is called timestamp")
    unit = names[column].partition("[")[2].rstrip("] ")
    try:
        values = np.array([float(row[column]) for row in rows[1:] if row])
    except IndexError:
        raise ValueError("rows have too few cells") from None
    return values * _UNITS.get(unit, 1.0)
