"""Packs Live Link Face CSV files, one a clip, so that engines play the motion.

The angles of head and eyes are 0, as the app writes them where head rotation is off; eyes turn by eyeLook*.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa

from facegen.conventions import SHARD_ROWS
from facegen.errors import InputError
from facegen.formats import live_link_csv
from facegen.packing.plan import Options, PackFile, PackFormat
from facegen.store import Dataset, column_array, read_shard


def clip_parts(dataset: Dataset, samples: Sequence[int], _options: Options) -> list[PackFile]:
    """One file a clip, named by person, session, clip and what is done in it.

    Raises
    ------
    InputError
        If the dataset has no clips but stills.
    InvalidData
        If a shard is damaged.
    """
    check_clips(dataset, "livelink")
    numbers = np.asarray(samples, np.int64)
    columns = ["person", "session", "clip", "component"]
    table = clip_rows(dataset, numbers, columns)
    clip = table.column("clip").to_numpy()
    first = np.flatnonzero(np.diff(clip, prepend=-1))
    parts = []
    for start, stop in zip(first, [*first[1:], len(clip)], strict=True):
        person, session, number, kind = (table.column(name)[int(start)].as_py() for name in columns)
        name = f"person-{person:05d}-session-{session:05d}-clip-{number:06d}-{kind}.csv"
        parts.append(PackFile(name=name, samples=numbers[start:stop].tolist()))
    return parts


def write_clip(dataset: Dataset, part: PackFile, _options: Options, path: Path) -> None:
    """Write one clip."""
    table = clip_rows(dataset, np.asarray(part.samples, np.int64), ["weights", "time_s"])
    text = live_link_csv(column_array(table, "weights"), table.column("time_s").to_numpy())
    path.write_text(text, encoding="utf-8", newline="")


def check_clips(dataset: Dataset, name: str) -> None:
    """Refuse a dataset of stills for a format that packs clips."""
    if dataset.spec.kind == "still":
        raise InputError(
            f"{dataset.folder.path}: holds stills; the format {name!r} packs the clips of sequences and playbacks"
        )


def clip_rows(dataset: Dataset, numbers: np.ndarray, columns: list[str]) -> pa.Table:
    """Columns of samples by number, in order; one shard in memory at a time."""
    tables = []
    for shard in np.unique(numbers // SHARD_ROWS):
        table = read_shard(dataset.folder.shard(int(shard)), columns)
        tables.append(table.take(pa.array(numbers[numbers // SHARD_ROWS == shard] % SHARD_ROWS)))
    return pa.concat_tables(tables)


LIVELINK = PackFormat(
    description="Live Link Face CSV, one file a clip, of sequences and playbacks",
    rendered=False,
    options=frozenset(),
    shard_size=0,
    parts=clip_parts,
    write=write_clip,
)
