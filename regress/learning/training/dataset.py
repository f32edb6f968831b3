"""Reads keypoints and weights of a facegen dataset (DESIGN: a dataset on disk)."""

import hashlib
import os
from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT, SHARD_ROWS, SPLITS
from facegen.documents import read_bytes
from regress.errors import InputError
from regress.learning.labels import Columns, read_labels
from regress.runtime.documents import read_document
from regress.runtime.features import align_affine, edge_distances, load_reference_shape

MOST_SHARD_BYTES = 2**28
"""Of one shard of 10,000 rows; ours have 40 MB."""

_REPAIR = "run facegen validate --repair, then facegen generate"


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
    samples = description.get("samples")
    whole = -(-samples // SHARD_ROWS) if isinstance(samples, int) else len(shards)
    if len(shards) < whole:
        raise InputError(
            f"{folder / 'keypoints'} holds {len(shards)} of {whole} shards; run facegen generate again, which makes "
            "what is missing"
        )
    columns = Columns(
        single={"person": "whole", "neutral": "truth", "split": "word"},
        lists={"weights": len(BLENDSHAPES), points: 2 * LANDMARK_COUNT},
        gaps=frozenset({points}),
    )
    digest = hashlib.sha256()
    read = []
    for shard in shards:
        content = read_bytes(shard, most_bytes=MOST_SHARD_BYTES)
        digest.update(content)
        read.append(read_labels(shard, columns, most_rows=SHARD_ROWS, damaged=_REPAIR, content=content))
    labels = {name: np.concatenate([shard[name] for shard in read]) for name in columns.names}
    with np.errstate(invalid="ignore"):  # a signalling NaN, of changed bytes, is a NaN like others
        landmarks = labels[points].astype(np.float64).reshape(-1, LANDMARK_COUNT, 2)
    # frames in which the detector finds no face teach nothing
    has_face = ~np.isnan(landmarks).all(axis=(1, 2))
    if not has_face.any():
        raise InputError(f"{folder / 'keypoints'}: no row has a face; all of {points} is NaN")
    landmarks, split = landmarks[has_face], labels["split"][has_face]
    if not np.isfinite(landmarks).all():
        raise InputError(f"{folder / 'keypoints'} holds points that are not finite numbers")
    _check_faces(landmarks, np.flatnonzero(has_face), folder / "keypoints")
    for name in splits:
        if not np.any(split == name):
            raise InputError(
                f"{folder} has no sample in the {name} split; people are needed in {', '.join(splits)}"
            )
    return KeypointDataset(
        name=os.fsencode(folder.resolve().name).decode("utf-8", "replace"),
        points=landmarks,
        weights=labels["weights"][has_face].astype(np.float64),
        split=split,
        person=labels["person"][has_face],
        neutral=labels["neutral"][has_face],
        description=description,
        sha256=digest.hexdigest(),
    )


def _description(path: Path) -> dict[str, Any]:
    if not path.is_file():
        raise InputError(f"{path} does not exist; a dataset is a folder that facegen generate has made")
    description = read_document(path)
    spec_hash = description.get("spec_hash")
    if spec_hash is not None and not isinstance(spec_hash, str):
        raise InputError(f"{path}: spec_hash is no text; facegen generate writes one")
    return description


def _check_faces(landmarks: np.ndarray, rows: np.ndarray, where: Path) -> None:
    """Refuse faces whose outer points lie on one line: they have no width, or no alignment."""
    laid = edge_distances(align_affine(landmarks, load_reference_shape().points[:, :2]), np.array([[0, 16]]))
    flat = ~np.isfinite(laid[:, 0])
    if flat.any():
        raise InputError(f"{where}: the points of row {rows[flat][0]} lie on one line, or on one another")
