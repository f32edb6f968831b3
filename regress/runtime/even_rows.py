"""Chooses rows that stand for all."""

import numpy as np


def even_rows(count: int, most: int) -> np.ndarray:
    """At most ``most`` of ``count`` rows, evenly apart, the first and the last among them."""
    return np.linspace(0, count - 1, min(count, most)).round().astype(int)
