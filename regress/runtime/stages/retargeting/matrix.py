"""A retargeting: from ARKit's 52 weights to those of another avatar's shapes."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Retargeting:
    """From the 52 ARKit weights to those of k other shapes: a product, then limits.

    Parameters
    ----------
    title, source
        What it is for, and where names and factors come from.
    names
        The k shapes, in the order of the result.
    factors : (52, k) float64
        Rows in `BLENDSHAPES` order.
    low, high : (k,) float64
        Limits of the result; 0 lies between them, so that a neutral face stays one.
    """

    title: str
    source: str
    names: tuple[str, ...]
    factors: np.ndarray
    low: np.ndarray
    high: np.ndarray

    def apply(self, weights: np.ndarray) -> np.ndarray:
        """Weights (n, k) of the target from ARKit weights (n, 52); rows of NaN stay NaN."""
        missing = np.isnan(weights).any(axis=1, keepdims=True)
        moved = np.clip(np.where(missing, 0.0, weights) @ self.factors, self.low, self.high)
        return np.where(missing, np.nan, moved)
