"""Packs Parquet of keypoints alone: chosen columns of all samples, in larger files than the dataset's own."""

from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import SHARD_ROWS
from facegen.errors import InputError
from facegen.packing.plan import Options, PackFile, PackFormat, split_shards
from facegen.store import Dataset

SHARD_SAMPLES = 100_000
"""About 250 MB with all columns."""


def chosen_columns(dataset: Dataset, options: Options) -> list[str]:
    """Names of the columns, in the shards' order; ``sample`` is always one, so that rows can be told apart.

    Raises
    ------
    InputError
        If there is no such column.
    """
    names = dataset.keypoint_schema.names
    unknown = sorted(set(options.columns or ()) - set(names))
    if unknown:
        raise InputError(f"--columns: {unknown[0]!r} is none of {', '.join(names)}")
    return [name for name in names if options.columns is None or name in options.columns or name == "sample"]


def write_keypoints(dataset: Dataset, part: PackFile, options: Options, path: Path) -> None:
    """Write one file; one shard of the dataset is in memory at a time."""
    columns = chosen_columns(dataset, options)
    schema = dataset.keypoint_schema
    about = {"licence": dataset.licence, "spec_hash": dataset.hash}
    schema = pa.schema([schema.field(name) for name in columns], metadata=about)
    with pq.ParquetWriter(path, schema, compression="zstd", write_page_checksum=True) as writer:
        for rows in dataset.rows(part.samples, columns):
            writer.write_table(rows.replace_schema_metadata(None).cast(schema), row_group_size=SHARD_ROWS)


KEYPOINTS = PackFormat(
    description="Parquet of the keypoints of all samples, with the columns you choose",
    rendered=False,
    options=frozenset({"shard_size", "columns"}),
    shard_size=SHARD_SAMPLES,
    parts=split_shards,
    write=write_keypoints,
    carded=True,
)
