"""Moments of several cameras: which frames of them go together."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True, eq=False)
class Moments:
    """Which frames of several cameras go together.

    Parameters
    ----------
    numbers : (n,) int64
        What the moments are called.
    rows : mapping of (n,) int64
        By camera: its frame of each moment, by its place in the recording; -1 where it has none.
    time_s : (n,) float64 or None
        Seconds from the first moment, where known.
    notes
        What a person should be told, a sentence each.
    """

    numbers: np.ndarray
    rows: Mapping[str, np.ndarray]
    time_s: np.ndarray | None
    notes: tuple[str, ...] = ()
