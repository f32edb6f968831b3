"""CSV files of OpenFace and py-feat: columns ``x_0 .. x_67`` and ``y_0 .. y_67``, read by name.

OpenFace puts a blank before each column's name, all x before all y, ``success`` 0 where it saw no face.
py-feat leaves cells empty there.
"""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames


@dataclass(frozen=True, kw_only=True)
class Table:
    """A CSV file: column numbers by stripped name, and rows of cells."""

    path: Path
    columns: dict[str, int]
    rows: list[list[str]]

    def numbers(self, name: str) -> np.ndarray:
        """A column as (n,) float64; empty cells are NaN."""
        column = self.columns[name]
        try:
            return np.array([float(row[column].strip() or "nan") for row in self.rows])
        except ValueError as error:
            raise InputError(
                f"{self.path}: column {name} holds something that is not a number ({error})"
            ) from error

    def text(self, name: str) -> list[str]:
        """A column as text."""
        return [row[self.columns[name]].strip() for row in self.rows]


def is_table(path: Path) -> bool:
    """Whether this is a ``.csv`` file."""
    return path.suffix.lower() == ".csv"


def read_table(path: Path) -> Frames:
    """Frames of an OpenFace or py-feat CSV, told apart by their columns."""
    table = _open(path)
    if "success" in table.columns:
        return read_openface(table)
    return read_pyfeat(table)


def read_openface(table: Table) -> Frames:
    """Frames of OpenFace: without success a frame has no face. Several faces are rows of their own."""
    points = _points(table)
    points[table.numbers("success") == 0] = np.nan
    labels = table.text("frame") if "frame" in table.columns else _count(table)
    if "face_id" in table.columns and len(set(labels)) < len(labels):
        labels = [f"{frame}/{face}" for frame, face in zip(labels, table.text("face_id"), strict=True)]
    time_s = table.numbers("timestamp") if "timestamp" in table.columns else None
    return Frames(points=points, labels=tuple(labels), time_s=time_s, source=str(table.path))


def read_pyfeat(table: Table) -> Frames:
    """Frames of py-feat; labels are its ``frame`` column, or count from 0."""
    labels = table.text("frame") if "frame" in table.columns else _count(table)
    return Frames(points=_points(table), labels=tuple(labels), time_s=None, source=str(table.path))


def _open(path: Path) -> Table:
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            header, *rows = [row for row in csv.reader(file) if row] or [[]]
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path} is not a CSV file: {error}") from error
    columns = {name.strip(): column for column, name in enumerate(header)}
    wanted = [f"{axis}_{index}" for axis in "xy" for index in range(LANDMARK_COUNT)]
    missing = [name for name in wanted if name not in columns]
    if missing:
        raise InputError(
            f"{path} lacks {len(missing)} of the columns x_0 .. x_67, y_0 .. y_67, first {missing[0]}; "
            "OpenFace and py-feat write them"
        )
    if not rows:
        raise InputError(f"{path} has a header and no rows")
    for number, row in enumerate(rows, start=2):
        if len(row) < len(header):
            raise InputError(f"{path}: row {number} has {len(row)} cells; the header names {len(header)}")
    return Table(path=path, columns=columns, rows=rows)


def _points(table: Table) -> np.ndarray:
    axes = [[table.numbers(f"{axis}_{index}") for index in range(LANDMARK_COUNT)] for axis in "xy"]
    return np.moveaxis(np.array(axes), (0, 1, 2), (2, 1, 0)).copy()


def _count(table: Table) -> list[str]:
    return [str(row) for row in range(len(table.rows))]
