"""Reads CSV files of numbers over time: a header, then a row a frame, of which nothing but the row at hand is kept."""

import csv
import math
import os
import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import TextIO

import numpy as np

from facegen.documents import unreadable
from facegen.errors import FormatError

MOST_ROWS = 1_000_000
"""Of one file: nine hours at 30 a second."""

MOST_ROW_CHARACTERS = 256 * 1024
"""Of one row: 40 times OpenFace's, which has 714 columns."""


class CsvRows:
    """A CSV file with a header, read row by row; use it in a ``with`` statement.

    Parameters
    ----------
    path
        UTF-8, with or without a byte order mark.

    Attributes
    ----------
    columns
        Column number by stripped name; of columns with one name the last.
    twice
        Names that stand over several columns.

    Raises
    ------
    FormatError
        Where it cannot be read, or is no CSV file.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        try:
            self._file = open(self.path, encoding="utf-8-sig", newline="")
        except FileNotFoundError:
            raise FormatError(f"{self.path}: there is no such file; a CSV is needed") from None
        except (OSError, ValueError) as error:
            raise FormatError(str(unreadable(self.path, error))) from None
        self._rows = self._read()
        try:
            names = [name.strip() for name in next(self._rows, [])]
        except BaseException:
            self._file.close()
            raise
        self.columns = {name: column for column, name in enumerate(names)}
        self.twice = {one for one, other in pairwise(sorted(names)) if one == other}
        self._width = len(names)

    def __enter__(self) -> "CsvRows":
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def check(self, names: Sequence[str]) -> None:
        """Refuse a file in which one of these names stands over several columns.

        Raises
        ------
        FormatError
            Names the first.
        """
        for name in names:
            if name in self.twice:
                raise FormatError(f"{self.path} has several columns {name}; one is needed")

    def __iter__(self) -> Iterator[list[str]]:
        """Cells of each row below the header.

        Raises
        ------
        FormatError
            Where a row lacks cells, there are none or more than `MOST_ROWS`, or the file is no CSV file.
        """
        number = 1
        for number, row in enumerate(self._rows, start=2):
            if len(row) < self._width:
                raise FormatError(
                    f"{self.path}: row {number} has {len(row)} cells; the header names {self._width}"
                )
            if number > MOST_ROWS + 1:
                raise FormatError(f"{self.path} has more than {MOST_ROWS:,} rows; give it in parts")
            yield row
        if number == 1:
            raise FormatError(f"{self.path} has a header and no rows")

    def _read(self) -> Iterator[list[str]]:
        lines = _Lines(self._file, self.path)
        try:
            for row in csv.reader(lines):
                lines.taken = 0
                if row:
                    yield row
        except (UnicodeDecodeError, csv.Error) as error:
            raise FormatError(f"{self.path} is not a CSV file: {error}") from error
        except OSError as error:
            raise FormatError(str(unreadable(self.path, error))) from None


class _Lines:
    """Lines of a file, as long as those of one row are not too many characters: quotes can hold line ends."""

    def __init__(self, file: TextIO, path: Path) -> None:
        self._file, self._path = file, path
        self.taken = 0

    def __iter__(self) -> "_Lines":
        return self

    def __next__(self) -> str:
        line = self._file.readline(MOST_ROW_CHARACTERS + 1)
        self.taken += len(line)
        if self.taken > MOST_ROW_CHARACTERS:
            raise FormatError(f"{self._path} has a row of more than {MOST_ROW_CHARACTERS:,} characters")
        if not line:
            raise StopIteration
        return line


_NO_NUMBER = re.compile(r"[+-]?(?:nan\((?:ind|snan)\)|1\.#(?:ind|qnan|snan)0*)|na", re.IGNORECASE)
"""How C programs on Windows write NaN, OpenFace among them, and R a missing value."""


def number_in(cell: str) -> float:
    """A cell's number; NaN where it is empty or says so.

    Raises
    ------
    ValueError
        Where it holds something else.
    """
    text = cell.strip()
    try:
        return float(text or "nan")
    except ValueError:
        if _NO_NUMBER.fullmatch(text):
            return math.nan
        raise


def numbers_in(row: Sequence[str], columns: Sequence[int]) -> np.ndarray:
    """Numbers (k,) float64 of a row's cells in these columns; NaN where they are empty or say so.

    Raises
    ------
    ValueError
        Where one holds something else.
    """
    return np.array([number_in(row[column]) for column in columns])
