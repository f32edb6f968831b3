"""Reads tables of labels that strangers may have written: every column's kind, length and numbers are checked."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from regress.errors import InputError

LARGEST = 1e9
"""Of any number in a list, either way: weights are about 1, pixels some thousands; squares of it still add up."""

LONGEST_WORD = 200
"""Characters of a split's or a component's name; a longer one would be repeated in every row."""

_KINDS = {
    "whole": (pa.types.is_integer, "whole numbers"),
    "number": (pa.types.is_floating, "numbers"),
    "truth": (pa.types.is_boolean, "true or false"),
    "word": (pa.types.is_dictionary, "texts"),
}


@dataclass(frozen=True, kw_only=True)
class Columns:
    """What is read of a table.

    Parameters
    ----------
    single
        Columns of one value a row, and what they hold.
    lists
        Columns of lists, and how many numbers each row has.
    gaps
        Lists in which numbers may be missing, as NaN.
    """

    single: Mapping[str, Literal["whole", "number", "truth", "word"]]
    lists: Mapping[str, int]
    gaps: frozenset[str] = field(default_factory=frozenset)

    @property
    def names(self) -> list[str]:
        """Of all of them."""
        return [*self.single, *self.lists]


def read_labels(
    path: Path,
    columns: Columns,
    *,
    most_rows: int,
    without: str = "",
    damaged: str = "make it again",
    content: bytes | None = None,
) -> dict[str, np.ndarray]:
    """Read columns of a Parquet file.

    Parameters
    ----------
    path, columns
        The file, and what is read of it.
    most_rows
        A longer table is not read.
    without, damaged
        What to do where a column is missing, and where the file cannot be read.
    content
        Its bytes, where they are at hand.

    Returns
    -------
    dict of arrays
        (n,) of single values, words as text; (n, k) of lists, in the file's precision.

    Raises
    ------
    InputError
        Where the file is no Parquet or longer, or a column is missing, of another kind, has empty cells, or numbers
        that are not finite or beyond `LARGEST`.
    """
    try:
        table = _table(path, columns, most_rows, without, content)
        return {
            **{name: _single(path, table, name, kind) for name, kind in columns.single.items()},
            **{
                name: _list(path, table, name, width, gaps=name in columns.gaps)
                for name, width in columns.lists.items()
            },
        }
    # KeyError: a nested column's name
    except (pa.ArrowException, KeyError, OSError, UnicodeDecodeError) as error:
        reason = next(iter(str(error).splitlines()), type(error).__name__)
        raise InputError(f"{path} cannot be read as Parquet ({reason}); {damaged}") from error


def _table(path: Path, columns: Columns, most_rows: int, without: str, content: bytes | None) -> pa.Table:
    words = [name for name, kind in columns.single.items() if kind == "word"]
    with pq.ParquetFile(
        path if content is None else pa.BufferReader(content),
        page_checksum_verification=True,
        read_dictionary=words,  # a long word that every row has is one in memory
    ) as file:
        rows, names = file.metadata.num_rows, file.schema_arrow.names
        if not 0 <= rows <= most_rows:
            raise InputError(f"{path} has {rows:,} rows; at most {most_rows:,} are expected")
        missing = [name for name in columns.names if name not in names]
        if missing:
            held = ", ".join(names[:20]) + (", ..." if len(names) > 20 else "")
            raise InputError(f"{path} lacks the column {missing[0]!r}{without or f'; it holds {held}'}")
        twice = [name for name in columns.names if names.count(name) > 1]
        if twice:
            raise InputError(f"{path} has two columns {twice[0]!r}")
        table = file.read(columns=columns.names)
    if len(table) != rows:
        raise InputError(f"{path} claims {rows:,} rows and has {len(table):,}")
    return table.combine_chunks()


def _single(path: Path, table: pa.Table, name: str, kind: str) -> np.ndarray:
    column = table.column(name)
    fits, wish = _KINDS[kind]
    if not fits(column.type) or column.null_count:
        raise InputError(f"{path}: column {name!r} is {column.type}; {wish} without empty cells are needed")
    if kind == "word":
        return _words(path, name, column)
    values = column.to_numpy()
    if kind == "number" and not np.isfinite(values).all():
        raise InputError(f"{path}: column {name!r} holds numbers that are not finite")
    return values


def _words(path: Path, name: str, column: pa.ChunkedArray) -> np.ndarray:
    column = column.unify_dictionaries()
    if not len(column):
        return np.zeros(0, dtype=str)
    known = column.chunk(0).dictionary
    longest = pc.max(pc.utf8_length(known)).as_py() if pa.types.is_string(known.type) else None
    if longest is None or longest > LONGEST_WORD:
        raise InputError(f"{path}: column {name!r} must have texts of at most {LONGEST_WORD} characters")
    words = np.asarray(known.to_pylist(), dtype=str)
    chosen = np.concatenate([chunk.indices.to_numpy() for chunk in column.chunks])
    if chosen.min() < 0 or chosen.max() >= len(words):  # damaged bytes
        raise InputError(f"{path}: column {name!r} names texts that it does not hold; make the file again")
    return words[chosen]


def _list(path: Path, table: pa.Table, name: str, width: int, *, gaps: bool) -> np.ndarray:
    column = table.column(name)
    kind = column.type
    if not (
        pa.types.is_fixed_size_list(kind)
        and kind.list_size == width
        and pa.types.is_floating(kind.value_type)
    ):
        raise InputError(f"{path}: column {name!r} is {kind}; lists of {width} numbers are needed")
    values = column.combine_chunks().flatten()
    if column.null_count or values.null_count or len(values) != width * len(table):
        raise InputError(f"{path}: column {name!r} has empty cells; lists of {width} numbers are needed")
    numbers = values.to_numpy().reshape(-1, width)
    sound = np.abs(numbers) <= LARGEST
    if not (sound | np.isnan(numbers) if gaps else sound).all():
        row = int(np.flatnonzero(~(sound | (np.isnan(numbers) & gaps)).all(axis=1))[0])
        raise InputError(
            f"{path}: column {name!r} holds numbers that are not finite, or beyond {LARGEST:g}, first in row {row}"
        )
    return numbers
