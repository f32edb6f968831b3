"""Says whether two labels are the same: those of two processors may differ in their last bits."""

from pathlib import Path

import numpy as np

from facegen.store.keypoint_table import column_array, read_shard

TOLERANCE = 1e-6
"""Stored numbers may differ by this much of their size (or of 1, if they are smaller).

Labels are float32: their last bit is 6e-8 of their size, and another processor's sine may move it; 1e-6 m is
0.001 mm, 1e-6 of 640 px is 0.0006 px.
"""


def differing_rows(stored: np.ndarray, made: np.ndarray) -> np.ndarray:
    """(n,) bool: rows of two arrays (n, ...) that differ by more than `TOLERANCE`; NaN equals NaN."""
    if stored.dtype.kind not in "fiub" or made.dtype.kind not in "fiub":
        differs = stored != made
    else:
        stored, made = stored.astype(np.float64), made.astype(np.float64)
        with np.errstate(invalid="ignore"):
            near = np.abs(stored - made) <= TOLERANCE * np.maximum(1.0, np.abs(made))
        differs = ~(near | (stored == made) | (np.isnan(stored) & np.isnan(made)))
    return differs.reshape(len(differs), -1).any(axis=1)


def same_labels(one: Path, other: Path) -> bool:
    """Whether two shards hold the same columns, and labels that differ by no more than `TOLERANCE`.

    Raises
    ------
    InvalidData
        If one of them cannot be read.
    """
    first, second = read_shard(one), read_shard(other)
    if len(first) != len(second) or not first.schema.equals(second.schema, check_metadata=True):
        return False
    return not any(
        differing_rows(column_array(first, name), column_array(second, name)).any()
        for name in first.column_names
    )
