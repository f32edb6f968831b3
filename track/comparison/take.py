"""Keeps a compared take as a labelled recording: a dataset of one person that `regress evaluate` reads."""

import json
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from facegen.files import check_new_folder, staging, write_whole

SHARD_ROWS = 10_000
"""Of a file of rows, as datasets have them."""


def check_place(folder: Path) -> None:
    """See that a take can be written, before there is one.

    Raises
    ------
    InputError
        Where something of that name is there.
    OutputError
        Where there is no folder to make it in.
    ModuleNotFoundError
        Without the extra ``learn``.
    """
    import pyarrow.parquet  # noqa: F401

    check_new_folder(folder, what="the take")


def write_take(folder: Path, *, points: np.ndarray, weights: np.ndarray, neutral: np.ndarray) -> Path:
    """Write a dataset; its folder must not be there yet.

    Parameters
    ----------
    folder
        To make.
    points : (n, 68, 2) float64
        As the detector gave them, pixels.
    weights : (n, 52) float64
        The phone's, of the same frames.
    neutral : (m, 68, 2) float64
        Of the person's neutral face, whose weights are 0; m may be 0.

    Raises
    ------
    InputError
        Where something of that name is there.
    OutputError
        Where it cannot be written.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    check_place(folder)
    faces = np.concatenate([neutral, points]).astype(np.float32).reshape(-1, 2 * LANDMARK_COUNT)
    labels = np.concatenate([np.zeros((len(neutral), len(BLENDSHAPES))), weights]).astype(np.float32)
    columns = {
        "person": pa.array(np.zeros(len(faces), dtype=np.int64)),
        "neutral": pa.array(np.arange(len(faces)) < len(neutral)),
        "split": pa.array(["test"] * len(faces)),
        "weights": _rows(labels),
        "detected_2d": _rows(faces),
    }
    table = pa.table(columns)
    with staging(folder.parent, f".{folder.name}") as part:
        (part / "keypoints").mkdir()
        for number, start in enumerate(range(0, len(table), SHARD_ROWS)):
            rows = table.slice(start, SHARD_ROWS)
            pq.write_table(rows, part / "keypoints" / f"shard-{number:05d}.parquet", write_page_checksum=True)
        description = {"format": "track-take", "version": 1, "rows": len(table), "neutral_rows": len(neutral)}
        write_whole(part / "dataset.json", json.dumps(description, indent=1) + "\n")
        part.rename(folder)
        part.mkdir()  # what `staging` takes away
    return folder


def _rows(values: np.ndarray):
    import pyarrow as pa

    return pa.FixedSizeListArray.from_arrays(pa.array(values.ravel()), values.shape[1])
