"""Makes a camera's typical picture, the small mean of its training pictures, and says how like it others are."""

import numpy as np

from regress.runtime.even_rows import even_rows

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

    chosen = rows[even_rows(len(rows), _PICTURES)]
    mean = np.mean(pictures[chosen], axis=0, dtype=np.float32)
    return np.rint(cv2.resize(mean, (TYPICAL_SIDE, TYPICAL_SIDE), interpolation=cv2.INTER_AREA)).astype(
        np.uint8
    )


def likeness(one: np.ndarray, other: np.ndarray) -> float:
    """Correlation of the grey levels of two pictures of one shape; 0 where one of them has a single level."""
    one, other = (picture - picture.mean(dtype=np.float64) for picture in (one, other))
    size = np.sqrt((one**2).sum() * (other**2).sum())
    return float((one * other).sum() / size) if size > 0 else 0.0
