"""Reads keypoints and weights of a facegen dataset (DESIGN: a dataset on disk)."""

import hashlib
import json
import os
from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT, SPLITS
from regress.errors import InputError

_WIDTHS = {"weights": len(BLENDSHAPES), "detected_2d": LANDMARK_COUNT * 2, "points_2d": LANDMARK_COUNT * 2}


@dataclass(frozen=True, kw_only=True)
class KeypointDataset:
    """What a regressor needs of a dataset.

    Parameters
    ----------
    name
        Name of the dataset's folder.
    points : (n, 68, 2) float64
        Detected landmarks, pixels, y down: with the noise that a detector would have.
    weights : (n, 52) float64
        In ``BLENDSHAPES`` order.
    split : (n,) str
        ``train``, ``validation`` or ``test``.
    person : (n,) int64
    neutral : (n,) bool
        Rows that show their person without an expression.
    description
        Content of dataset.json.
    sha256
        Of the bytes of all shards, in order.
    """

    name: str
    points: np.ndarray
    weights: np.ndarray
    split: np.ndarray
    person: np.ndarray
    neutral: np.ndarray
    description: dict[str, Any]
    sha256: str

    def rows(self, split: str) -> np.ndarray:
        """Row numbers of a split."""
        return np.flatnonzero(self.split == split)

    def take(self, rows: np.ndarray) -> "KeypointDataset":
        """The dataset of these rows alone; its description stays that of the whole."""
        return replace(
            self,
            points=self.points[rows],
            weights=self.weights[rows],
            split=self.split[rows],
            person=self.person[rows],
            neutral=self.neutral[rows],
        )

    @property
    def has_neutral_frames(self) -> bool:
        """Whether every split has a face beside its person's neutral one."""
        beside_neutral = (self.neutral_rows() >= 0) & ~self.neutral
        return all(bool(np.any(beside_neutral[self.rows(split)])) for split in SPLITS)

    def neutral_rows(self) -> np.ndarray:
        """(n,) int64: for each row the first neutral row of its person, -1 where there is none."""
        candidates = np.flatnonzero(self.neutral)
        people, first = np.unique(self.person[candidates], return_index=True)
        if not len(people):
            return np.full(len(self.person), -1)
        place = np.minimum(np.searchsorted(people, self.person), len(people) - 1)
        return np.where(people[place] == self.person, candidates[first][place], -1)


def read_dataset(
    folder: str | os.PathLike[str], *, points: str = "detected_2d", splits: Collection[str] = SPLITS
) -> KeypointDataset:
    """Read the keypoints of a dataset made by ``facegen generate``; rows without a face are left out.

    Parameters
    ----------
    folder
        With dataset.json and keypoints.
    points
        Column of the points: ``detected_2d``, or ``points_2d`` for the exact ones.
    splits
        Those that must have samples: training takes all of them.

    Raises
    ------
    InputError
        Where the folder is no dataset, a column is missing or has another width, or one of ``splits`` is empty.
    """
    folder = Path(folder)
    description = _description(folder / "dataset.json")
    shards = sorted((folder / "keypoints").glob("shard-*.parquet"))
    if not shards:
        raise InputError(f"{folder / 'keypoints'} holds no shard-*.parquet; facegen generate writes them")
    digest = hashlib.sha256()
    tables = []
    for shard in shards:
        content = shard.read_bytes()
        digest.update(content)
        tables.append(_table(shard, content, points))
    table = pa.concat_tables(tables)
    landmarks = _column(table, points).reshape(-1, LANDMARK_COUNT, 2)
    has_face = ~np.isnan(landmarks).all(
        axis=(1, 2)
    )  # frames in which the detector finds no face teach nothing
    if not has_face.any():
        raise InputError(f"{folder / 'keypoints'}: no row has a face; all of {points} is NaN")
    table, landmarks = table.filter(has_face), landmarks[has_face]
    weights = _column(table, "weights")
    if not (np.isfinite(landmarks).all() and np.isfinite(weights).all()):
        raise InputError(f"{folder / 'keypoints'} holds points or weights that are not finite numbers")
    split = np.array(table.column("split").to_pylist())
    for name in splits:
        if not np.any(split == name):
            raise InputError(
                f"{folder} has no sample in the {name} split; people are needed in {', '.join(splits)}"
            )
    return KeypointDataset(
        name=folder.resolve().name,
        points=landmarks,
        weights=weights,
        split=split,
        person=table.column("person").to_numpy(),
        neutral=table.column("neutral").to_numpy().astype(bool),
        description=description,
        sha256=digest.hexdigest(),
    )


def _description(path: Path) -> dict[str, Any]:
    if not path.is_file():
        raise InputError(f"{path} does not exist; a dataset is a folder that facegen generate has made")
    try:
        description = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, OSError) as error:
        raise InputError(f"{path} is not readable JSON: {error}") from error
    if not isinstance(description, dict):
        raise InputError(f"{path} holds {type(description).__name__}; a JSON object is needed")
    return description


def _table(shard: Path, content: bytes, points: str) -> pa.Table:
    columns = ["person", "neutral", "split", "weights", points]
    try:
        file = pq.ParquetFile(pa.BufferReader(content), page_checksum_verification=True)
        missing = [name for name in columns if name not in file.schema_arrow.names]
        if missing:
            raise InputError(
                f"{shard} lacks the column {missing[0]!r}; it holds {', '.join(file.schema_arrow.names)}"
            )
        table = file.read(columns=columns)
    except (pa.ArrowException, OSError) as error:
        raise InputError(
            f"{shard} cannot be read as Parquet ({error}); run facegen validate --repair, then facegen generate"
        ) from error
    for name in ("weights", points):
        width = _WIDTHS[name]
        kind = table.schema.field(name).type
        if not pa.types.is_fixed_size_list(kind) or kind.list_size != width:
            raise InputError(f"{shard}: column {name!r} is {kind}; lists of {width} numbers are needed")
    return table


def _column(table: pa.Table, name: str) -> np.ndarray:
    flat = table.column(name).combine_chunks().flatten().to_numpy()
    return flat.reshape(-1, _WIDTHS[name]).astype(np.float64)
