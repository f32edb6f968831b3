"""A convolution over the frames before: what a network's answers gain from what it said just now.

The second paper's networks see the previous frames through a temporal convolution. Here one stands behind the network:
each weight and each angle of the gaze is a mean of the last five answers, weighted by taps that least squares choose on
clips of people whom the network has not seen (``regress.learning.headset.taps``). Taps add up to 1, so that a face that
is held stays as it is.
"""

import numpy as np

from regress.runtime.headset.network.model import TAPS


def convolve(values: np.ndarray, starts: np.ndarray, taps: np.ndarray) -> np.ndarray:
    """Each row as its taps weigh it and the rows before it.

    Parameters
    ----------
    values : (n, k)
        Rows of NaN stay NaN, and what follows one is a start.
    starts : (n,) bool
        Rows before which there is nothing: there the first row stands in for those that lack.
    taps : (k, TAPS)
        The row's own first.
    """
    lacks = np.isnan(values).any(axis=1)
    starts = starts | np.concatenate([[True], lacks[:-1]])
    return np.einsum("nlk,kl->nk", lagged(values, starts), taps)


def lagged(values: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """(n, TAPS, k): each row and those before it, back to its clip's first, which stands in for what lacks."""
    row = np.arange(len(values))
    first = np.maximum.accumulate(np.where(starts, row, 0))
    return values[np.maximum(row[:, None] - np.arange(TAPS), first[:, None])]
