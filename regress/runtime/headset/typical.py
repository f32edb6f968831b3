"""What a camera's pictures look like on average: a small square, by which the camera is known again."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

TYPICAL_SIDE = 24
"""Pixels: a brow, a lid and a lip are still told apart, and people are not."""

_PICTURES = 1024
"""Evenly chosen, of which a mean is made: more do not change it."""


def typical_picture(pictures: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Mean of pictures as a small square.

    Parameters
    ----------
    pictures : (n, h, w) uint8
    rows : (k,) int
        Of pictures that count, at least one.

    Returns
    -------
    (24, 24) uint8
    """
    import cv2

    chosen = rows[np.linspace(0, len(rows) - 1, min(len(rows), _PICTURES)).round().astype(int)]
    mean = np.mean(pictures[chosen], axis=0, dtype=np.float32)
    return np.rint(cv2.resize(mean, (TYPICAL_SIDE, TYPICAL_SIDE), interpolation=cv2.INTER_AREA)).astype(
        np.uint8
    )


def read_typical(
    document: Mapping[str, Any], cameras: Sequence[str]
) -> dict[str, tuple[tuple[int, ...], ...]]:
    """Typical pictures of a model.json.

    Raises
    ------
    ValueError
        Where one is of no camera, or is not 24 x 24 whole numbers from 0 to 255.
    """
    typical = {}
    for name, rows in document.items():
        if name not in cameras:
            raise ValueError(f"typical has a picture of {name}, and the cameras are {', '.join(cameras)}")
        levels = np.array(rows)
        if (
            levels.dtype.kind != "i"
            or levels.shape != (TYPICAL_SIDE,) * 2
            or levels.min() < 0
            or levels.max() > 255
        ):
            raise ValueError(
                f"typical of {name} is not {TYPICAL_SIDE} x {TYPICAL_SIDE} grey levels, whole numbers from 0 to 255"
            )
        typical[name] = tuple(map(tuple, levels.tolist()))
    return typical
