"""Packs Live Link Face CSV files, one a clip, so that engines play the motion.

The angles of head and eyes are 0, as the app writes them where head rotation is off; eyes turn by eyeLook*.
"""

import itertools
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa

from facegen.errors import InputError
from facegen.formats import live_link_csv
from facegen.packing.plan import Options, PackFile, PackFormat
from facegen.store import Dataset, column_array


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
    table = pa.concat_tables(dataset.rows(numbers, columns))
    parts = []
    for rows in runs(table.column("clip").to_numpy()):
        person, session, number, kind = (table.column(name)[rows.start].as_py() for name in columns)
        name = f"person-{person:05d}-session-{session:05d}-clip-{number:06d}-{kind}.csv"
        parts.append(PackFile(name=name, samples=numbers[rows].tolist()))
    return parts


def write_clip(dataset: Dataset, part: PackFile, _options: Options, path: Path) -> None:
    """Write one clip."""
    table = pa.concat_tables(dataset.rows(part.samples, ["weights", "time_s"]))
    text = live_link_csv(column_array(table, "weights"), table.column("time_s").to_numpy())
    path.write_text(text, encoding="utf-8", newline="")


def runs(values: np.ndarray) -> list[slice]:
    """Slices of equal neighbours in numbers (n,) of 0 or more, in order."""
    first = [*np.flatnonzero(np.diff(values, prepend=-1)).tolist(), len(values)]
    return [slice(start, stop) for start, stop in itertools.pairwise(first)]


def check_clips(dataset: Dataset, name: str) -> None:
    """Refuse a dataset of stills for a format that packs clips."""
    if dataset.spec.kind == "still":
        raise InputError(
            f"{dataset.folder.path}: holds stills; the format {name!r} packs the clips of sequences and playbacks"
        )


LIVELINK = PackFormat(
    description="Live Link Face CSV, one file a clip, of sequences and playbacks",
    rendered=False,
    options=frozenset(),
    shard_size=0,
    parts=clip_parts,
    write=write_clip,
)
