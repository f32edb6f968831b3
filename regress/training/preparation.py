"""Training data in the form the networks want: z-scored, in principal axes, padded to one shape."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, MIRRORED_BLENDSHAPES, MIRRORED_LANDMARKS
from regress.features import Features, extract
from regress.model import Normalisation
from regress.networks import Rows
from regress.targets import NETWORKS, OUTPUTS
from regress.training.dataset import KeypointDataset

OUTPUT_COLUMNS = [BLENDSHAPE_INDEX[name] for name in OUTPUTS]
"""Where the predicted shapes stand among the 52."""

WIDEST = max(len(network.outputs) for network in NETWORKS)

_FLOAT = np.float32
"""Training's precision: errors agree with float64 to four digits at alphas from 0.1, in half the time."""


@dataclass(frozen=True, kw_only=True)
class Split:
    """One split, standardised.

    Parameters
    ----------
    inputs : (n, E) float64
        Z-scored features in principal axes.
    targets : (n, O) float64
        Z-scored weights in ``OUTPUTS`` order.
    """

    inputs: np.ndarray
    targets: np.ndarray

    def take(self, rows: np.ndarray | slice) -> "Split":
        """Some of the rows."""
        return Split(inputs=self.inputs[rows], targets=self.targets[rows])

    def network_rows(self) -> Rows:
        """The same in the layout and precision of :class:`NetworkProblem`."""
        ones = np.ones((1, len(self.inputs)), dtype=_FLOAT)
        targets = np.zeros((len(NETWORKS), WIDEST, len(self.targets)), dtype=_FLOAT)
        for row, columns in enumerate(network_columns()):
            targets[row, : len(columns)] = self.targets[:, columns].T
        return Rows(inputs=np.concatenate([self.inputs.T.astype(_FLOAT), ones]), targets=targets)


@dataclass(frozen=True, kw_only=True)
class Prepared:
    """All splits, and the way back to features and weights.

    Parameters
    ----------
    splits
        By name.
    normalisation
        Z-scores of the training split.
    rotation : (E, E) float64
        Columns are the principal axes of the z-scored features.
    """

    splits: dict[str, Split]
    normalisation: Normalisation
    rotation: np.ndarray


def network_columns() -> list[range]:
    """Columns of ``OUTPUTS`` that each network gives."""
    ends = np.cumsum([len(network.outputs) for network in NETWORKS])
    return [range(end - len(network.outputs), end) for end, network in zip(ends, NETWORKS, strict=True)]


def used_outputs() -> np.ndarray:
    """(31, K): 1 where a network has that output, 0 for padding."""
    used = np.zeros((len(NETWORKS), WIDEST), dtype=_FLOAT)
    for row, network in enumerate(NETWORKS):
        used[row, : len(network.outputs)] = 1
    return used


def mirrored(points: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The mirror images of faces (n, 68, 2) and their weights (n, 52)."""
    return points[:, list(MIRRORED_LANDMARKS)] * [-1, 1], weights[:, list(MIRRORED_BLENDSHAPES)]


def prepare(dataset: KeypointDataset, features: Features, *, mirror: bool) -> Prepared:
    """Standardise all splits by the training split; the held-out splits are never mirrored.

    The rotation into principal axes changes no cost (``|W1 V| = |W1|``) and makes X'X diagonal for the
    preconditioner. Nothing is cut off: low-variance axes carry signal.
    """
    raw: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    for split in ("train", "validation", "test"):
        rows = dataset.rows(split)
        points, weights = dataset.points[rows], dataset.weights[rows]
        if mirror and split == "train":
            reflected = mirrored(points, weights)
            points, weights = np.concatenate([points, reflected[0]]), np.concatenate([weights, reflected[1]])
        raw[split] = extract(features, points), weights[:, OUTPUT_COLUMNS]
    inputs, targets = raw["train"]
    normalisation = Normalisation(
        feature_mean=inputs.mean(axis=0),
        feature_std=_spread(inputs),
        target_mean=targets.mean(axis=0),
        target_std=_spread(targets),
    )
    standard = (inputs - normalisation.feature_mean) / normalisation.feature_std
    _, axes = np.linalg.eigh(standard.T @ standard)
    rotation = axes[:, ::-1]
    splits = {
        split: Split(
            inputs=((inputs - normalisation.feature_mean) / normalisation.feature_std) @ rotation,
            targets=(targets - normalisation.target_mean) / normalisation.target_std,
        )
        for split, (inputs, targets) in raw.items()
    }
    return Prepared(splits=splits, normalisation=normalisation, rotation=rotation)


def _spread(values: np.ndarray) -> np.ndarray:
    spread = values.std(axis=0)
    return np.where(spread > 0, spread, 1.0)  # a shape that never moves stays at 0 instead of NaN
