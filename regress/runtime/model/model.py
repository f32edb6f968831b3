"""Holds a trained model of 68 points, and predicts with it."""

from dataclasses import dataclass, replace

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.features import Features, extract
from regress.runtime.model.record import TrainingRecord
from regress.runtime.networks import FoldedNetworks, evaluate, shifted
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
class Calibrated:
    """Networks that compare a frame with the person's neutral frame.

    Parameters
    ----------
    features
        What they see of a frame.
    normalisation
        Z-scores of the features' differences.
    networks
        Folded weights that act on a frame's features less the neutral frame's.
    """

    features: Features
    normalisation: Normalisation
    networks: FoldedNetworks


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
        The folded weights, for a frame by itself.
    record
        How it was trained; None for a model that ``regress train`` did not make.
    calibrated
        Networks for a frame whose person's neutral frame is known; None where a model has none.
    """

    recipe: str
    table: tuple[Network, ...]
    features: Features
    normalisation: Normalisation
    networks: FoldedNetworks
    record: TrainingRecord | None = None
    calibrated: Calibrated | None = None

    @property
    def outputs(self) -> tuple[str, ...]:
        """Predicted shapes in the networks' order (51; tongueOut is not among them)."""
        return tuple(output for network in self.table for output in network.outputs)

    @property
    def all_features(self) -> tuple[Features, ...]:
        """What the networks for a frame alone see, and what those that compare see."""
        return (self.features,) if self.calibrated is None else (self.features, self.calibrated.features)

    def calibrate(self, neutral: np.ndarray) -> "Model":
        """The model of one person and detector: its networks compare every frame with the neutral one.

        Differences cancel what a face is like and where a detector puts its points. The neutral features go
        into the first layer's biases, so the result is a model like any other: it predicts, is saved and is
        exported without knowing of calibration.

        Parameters
        ----------
        neutral : (m, 68, 2) or (68, 2) float
            Neutral frames of the person, or one, by the detector that will be used; the median of their features
            counts, so a blink among them does no harm. Frames with missing points are left out.

        Raises
        ------
        InputError
            Where the model has no calibrated networks, or no frame is usable.
        """
        if self.calibrated is None:
            raise InputError(
                "the model has no calibrated networks: its dataset had no neutral faces, or its recipe "
                f"({self.recipe}) leaves them out"
            )
        points = np.asarray(neutral, dtype=np.float64)
        points = points[None] if points.ndim == 2 else points
        if points.ndim != 3 or points.shape[1:] != (LANDMARK_COUNT, 2):
            raise InputError(f"neutral points have shape {points.shape}; (m, 68, 2) is needed")
        features = extract(self.calibrated.features, points[np.isfinite(points).all(axis=(1, 2))])
        features = features[np.isfinite(features).all(axis=1)]
        if not len(features):
            raise InputError("no neutral frame is usable: each has missing landmarks")
        origin = np.median(features, axis=0)
        normalisation = self.calibrated.normalisation
        return replace(
            self,
            features=self.calibrated.features,
            normalisation=replace(normalisation, feature_mean=normalisation.feature_mean + origin),
            networks=shifted(self.calibrated.networks, origin),
            calibrated=None,
        )

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
