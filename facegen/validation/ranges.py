"""Checks that labels have values that are possible, whatever the spec says."""

from collections.abc import Iterator

import numpy as np

from facegen.conventions import RECORDED_WEIGHTS, Visibility

UNIT = 1e-5
"""Lengths of unit vectors and products of rotations may be off by float32's rounding, about 1e-7 each."""


def impossible(
    *, weights: np.ndarray, visibility: np.ndarray, gaze: np.ndarray, transforms: np.ndarray, recorded: bool
) -> Iterator[tuple[str, int, str]]:
    """Label, row and description of values that cannot be.

    Parameters
    ----------
    weights
        (n, 52), between 0 and 1 unless ``recorded``.
    visibility
        (n, ...) numbers of `facegen.conventions.Visibility`.
    gaze
        (n, 2, 3) unit vectors.
    transforms
        (n, 4, 4) rigid motions.
    recorded
        Weights come from a recording.
    """
    low, high = RECORDED_WEIGHTS if recorded else (0.0, 1.0)
    # labels are float32, whose 1.6 is more than 1.6
    stored = weights.astype(np.float32)
    inside = (stored >= np.float32(low)) & (stored <= np.float32(high))
    yield from _rows("weights", ~inside, f"a weight lies outside {low:g} to {high:g}")
    known = np.isin(visibility, [int(value) for value in Visibility])
    yield from _rows("visibility", ~known, "a visibility is none of 0, 1, 2")
    length = np.linalg.norm(gaze.astype(np.float64), axis=-1)
    yield from _rows("gaze", ~(np.abs(length - 1) <= UNIT), "an optical axis is no unit vector")
    rotation = transforms[:, :3, :3]
    with np.errstate(invalid="ignore"):
        product = np.abs(rotation @ rotation.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
        rigid = (product <= UNIT) & (np.linalg.det(rotation) > 0)
        rigid &= (transforms[:, 3] == (0, 0, 0, 1)).all(axis=1)
    yield from _rows("camera_from_head", ~rigid, "is no rigid motion")


def _rows(name: str, wrong: np.ndarray, what: str) -> Iterator[tuple[str, int, str]]:
    for row in np.flatnonzero(wrong.reshape(len(wrong), -1).any(axis=1)):
        yield name, int(row), what
