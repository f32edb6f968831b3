"""A trained model as values, and what it predicts."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, LANDMARK_COUNT
from regress.errors import InputError
from regress.features import Features, extract
from regress.networks import FoldedNetworks, evaluate
from regress.targets import Network

_BLOCK_ROWS = 4096
"""Rows predicted at a time: 4096 x 620 hidden units are 20 MB."""


@dataclass(frozen=True, kw_only=True)
class Normalisation:
    """The z-scores of the training split; already folded into the weights, kept for reading.

    Parameters
    ----------
    feature_mean, feature_std : (E,) float64
        Face widths.
    target_mean, target_std : (O,) float64
        In the networks' output order.
    """

    feature_mean: np.ndarray
    feature_std: np.ndarray
    target_mean: np.ndarray
    target_std: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Model:
    """Everything needed to predict, and the record of how it came about.

    Parameters
    ----------
    recipe
        Name of the recipe: ``"default"`` or ``"paper"``.
    table
        The networks, in the order of the folded weights.
    features
        Alignment and edges.
    normalisation
        Z-scores, for reading only.
    networks
        The folded weights.
    record
        Training record: JSON data, every figure unrounded (see ``regress.training``).
    """

    recipe: str
    table: tuple[Network, ...]
    features: Features
    normalisation: Normalisation
    networks: FoldedNetworks
    record: dict[str, Any]

    @property
    def outputs(self) -> tuple[str, ...]:
        """Predicted shapes in the networks' order (51; tongueOut is not among them)."""
        return tuple(output for network in self.table for output in network.outputs)

    def predict_raw(self, points: np.ndarray) -> np.ndarray:
        """What the networks say, unclipped, in their own order (see ``outputs``).

        Parameters
        ----------
        points : (n, 68, 2) float
            Faces in pixels or any other unit, y down.

        Returns
        -------
        (n, O) float64
            Rows of NaN where a face has missing points.
        """
        points = np.asarray(points, dtype=np.float64)
        if points.ndim != 3 or points.shape[1:] != (LANDMARK_COUNT, 2):
            raise InputError(f"points have shape {points.shape}; (n, 68, 2) is needed")
        usable = np.isfinite(points).all(axis=(1, 2))
        raw = np.full((len(points), len(self.networks.b2)), np.nan)
        rows = np.flatnonzero(usable)
        for start in range(0, len(rows), _BLOCK_ROWS):
            block = rows[start : start + _BLOCK_ROWS]
            raw[block] = evaluate(self.networks, extract(self.features, points[block]))
        return raw

    def predict(self, points: np.ndarray) -> np.ndarray:
        """Blendshape weights of faces.

        Parameters
        ----------
        points : (n, 68, 2) float
            Faces in pixels or any other unit, y down, iBUG order.

        Returns
        -------
        (n, 52) float64
            In the order of ``facegen.conventions.BLENDSHAPES``, clipped to [0, 1]; tongueOut is 0. A
            face with a missing point gives a row of NaN, so nothing downstream takes it for a neutral face.
        """
        raw = self.predict_raw(points)
        weights = np.zeros((len(raw), len(BLENDSHAPES)))
        weights[:, [BLENDSHAPE_INDEX[name] for name in self.outputs]] = np.clip(raw, 0, 1)
        weights[np.isnan(raw).any(axis=1)] = np.nan
        return weights
