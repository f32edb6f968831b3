"""Measures noise from frame to frame by second differences, in which steady movements leave nothing."""

import numpy as np

SECOND_DIFFERENCE = 0.6745 * 6**0.5
"""Median of |a - 2b + c| of three values of standard deviation 1."""


def frame_noise(values: np.ndarray) -> np.ndarray:
    """Standard deviation (k,) of the noise of values (n, k) in the order of time, three frames or more."""
    return np.median(np.abs(values[2:] - 2 * values[1:-1] + values[:-2]), axis=0) / SECOND_DIFFERENCE
