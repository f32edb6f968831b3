"""Writes and reads keypoint shards, the Parquet files of a dataset."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from facegen.errors import InvalidData
from facegen.labels import Keypoints, further_columns
from facegen.sampling import Samples
from facegen.spec import Spec, shares_of
from facegen.store.arrow_arrays import DTYPES, arrow_array
from facegen.store.columns import RIG, shard_columns

MOST_ROW_BYTES = 16 * 1024
"""Of one row, unpacked: it has some 900 numbers and three words, about 4 kB."""
MOST_HEADER_BYTES = 1024**2
"""Of a file, beside its rows."""


def keypoint_schema(spec: Spec, components: int) -> pa.Schema:
    """Columns of a spec's shards, whose rigs have at most that many identity components; each says its unit and shape.

    Where there are several rigs, the last column names each row's.
    """
    fields = [column.field for column in shard_columns(components, further_columns(spec))]
    return pa.schema(fields if len(shares_of(spec.rig)) == 1 else [*fields, RIG])


def keypoint_table(spec: Spec, samples: Samples, keypoints: Keypoints) -> pa.Table:
    """Table of labelled samples; float64 becomes float32 here, cameras and times stay float64."""
    columns = shard_columns(samples.identity.shape[1], further_columns(spec))
    arrays = [arrow_array(column.values(samples, keypoints), column.kind) for column in columns]
    return pa.table(arrays, schema=pa.schema([column.field for column in columns]))


def write_shard(table: pa.Table, path: Path) -> None:
    """Write a shard, every page with a checksum; equal tables give equal bytes with one version of pyarrow.

    Only columns of few values get a dictionary: floats rarely repeat, and looking made files half as large again and
    writing four times as slow.
    """
    pq.write_table(
        table,
        path,
        compression="zstd",
        use_dictionary=["split", "sex", "component", "image_size.list.element"],
        row_group_size=len(table),
        write_statistics=True,
        write_page_checksum=True,
    )


def read_shard(
    path: Path,
    columns: Sequence[str] | None = None,
    *,
    schema: pa.Schema | None = None,
    rows: int | None = None,
) -> pa.Table:
    """Read a shard, or some of its columns; the checksums of all pages read are verified.

    Parameters
    ----------
    path
        The file.
    columns
        Names; all without.
    schema
        What the dataset's shards have; other columns are refused before any are read.
    rows
        How many it has to hold.

    Raises
    ------
    InvalidData
        If the file cannot be read, is not what was written, or has other columns or rows.
    """
    advice = "run facegen validate --repair, then facegen generate"
    try:
        with pq.ParquetFile(path, page_checksum_verification=True) as file:
            wrong = _other_content(file, schema, rows)
            if wrong is None:
                return file.read(columns=None if columns is None else list(columns))
    except (OSError, ValueError, KeyError, OverflowError, MemoryError, pa.ArrowException) as error:
        raise InvalidData(f"{path}: cannot be read as Parquet ({_one_line(error)}); {advice}") from None
    raise InvalidData(f"{path}: {wrong}; {advice}")


def _other_content(file: pq.ParquetFile, schema: pa.Schema | None, rows: int | None) -> str | None:
    """What the file's own description has instead of a shard's columns and rows."""
    if schema is not None and not has_columns(file.schema_arrow, schema):
        return "has other columns than this version of facegen writes"
    total = file.metadata.num_rows
    if rows is not None and total != rows:
        return f"has {total} rows, but should have {rows}"
    size = sum(file.metadata.row_group(group).total_byte_size for group in range(file.num_row_groups))
    if size > MOST_ROW_BYTES * total + MOST_HEADER_BYTES:
        return f"unpacks to {size:,} bytes, which {total} rows cannot have"
    return None


def has_columns(schema: pa.Schema, expected: pa.Schema) -> bool:
    """Whether names, types and descriptions are as expected; reading adds metadata of its own."""
    return schema.equals(expected, check_metadata=False) and all(
        field.metadata.items() <= (schema.field(field.name).metadata or {}).items() for field in expected
    )


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())


def column_array(table: pa.Table, name: str) -> np.ndarray:
    """A column as (n, ...) array in the shape its field's metadata tells."""
    column = table.column(name).combine_chunks()
    field = table.schema.field(name)
    if pa.types.is_list(field.type):
        return np.empty((len(column), 0), DTYPES[field.type.value_type])
    if not pa.types.is_fixed_size_list(field.type):
        return column.to_numpy(zero_copy_only=False)
    shape = (field.metadata or {}).get(b"shape", str(field.type.list_size).encode()).decode()
    return column.flatten().to_numpy().reshape(len(column), *(int(size) for size in shape.split()))
