"""Makes a model whose answer to a mirrored face is the mirrored answer, exactly."""

from dataclasses import dataclass, replace

import numpy as np

from facegen.conventions import mirrored_name
from regress.errors import InputError
from regress.runtime.features import Features, closed_under_mirror, mirrored_edges
from regress.runtime.model.model import Calibrated, Model, Normalisation
from regress.runtime.networks import FoldedNetworks


def symmetrised(model: Model) -> Model:
    """The mean of a model's answer and of its mirrored answer to the mirrored face, as one model.

    Each network gets twice its hidden units: its own, and the same looking at the mirror image, whose features
    are those of the face in another order. The few edges without a mirror partner get one. It is calibrated,
    saved and exported like any other model, and costs twice the time. A model that its recipe has made
    symmetric comes back as it is.

    Raises
    ------
    InputError
        Where a network gives a shape and not the one of the other side.
    """
    if model.record is not None and model.record.recipe.get("symmetric"):
        return model
    outputs = _mirrored_outputs(model)
    closed = _closed(model.features)
    calibrated = None
    if model.calibrated is not None:
        beside = _closed(model.calibrated.features)
        calibrated = Calibrated(
            features=beside.features,
            normalisation=beside.wider(model.calibrated.normalisation),
            networks=_twice(model.calibrated.networks, beside, outputs),
        )
    return replace(
        model,
        features=closed.features,
        normalisation=closed.wider(model.normalisation),
        networks=_twice(model.networks, closed, outputs),
        calibrated=calibrated,
    )


@dataclass(frozen=True, kw_only=True)
class _Closed:
    """Features of which each has its mirror partner among them.

    Parameters
    ----------
    features
        With the partners that were missing.
    own : (e,) int64
        Where each feature of the model is now.
    source : (E,) int64
        The feature of the model that each takes its mean and spread from.
    """

    features: Features
    own: np.ndarray
    source: np.ndarray

    def wider(self, normalisation: Normalisation) -> Normalisation:
        """Z-scores of all features."""
        return replace(
            normalisation,
            feature_mean=normalisation.feature_mean[self.source],
            feature_std=normalisation.feature_std[self.source],
        )


def _closed(features: Features) -> _Closed:
    if features.of_points:
        rows = np.arange(features.count)
        return _Closed(features=features, own=rows, source=rows)
    edges = closed_under_mirror(features.edges)
    row = {(int(i), int(j)): place for place, (i, j) in enumerate(edges)}
    own = np.array([row[int(i), int(j)] for i, j in features.edges])
    # a partner that the model did not have is as long, in the mean, as the edge that it mirrors
    source = np.zeros(len(edges), dtype=np.int64)
    source[mirrored_edges(edges)[own]] = np.arange(len(own))
    source[own] = np.arange(len(own))
    return _Closed(features=replace(features, edges=edges), own=own, source=source)


def _mirrored_outputs(model: Model) -> np.ndarray:
    """Row of each output's partner on the other side of the face, which is itself for shapes without a side."""
    names = model.outputs
    rows = np.array(
        [names.index(mirrored_name(name)) if mirrored_name(name) in names else -1 for name in names]
    )
    owners = model.networks.network_of_output
    if (rows < 0).any() or (owners[rows] != owners).any():
        raise InputError(
            "the model cannot be made symmetric: a network gives shapes of one side of the face only"
        )
    return rows


def _twice(networks: FoldedNetworks, closed: _Closed, outputs: np.ndarray) -> FoldedNetworks:
    hidden = networks.hidden
    partners, signs = closed.features.mirror
    mirrored, turned = partners[closed.own], signs[closed.own]
    w1 = networks.w1.reshape(len(networks.b1) // hidden, hidden, -1)
    if networks.denoising is not None:  # the mirror image has the same places along the axes, but for signs
        axes = networks.denoising.axes
        sides = np.where(np.einsum("ae,ae->a", axes, axes[:, mirrored] * turned) < 0, -1.0, 1.0)
        both = np.concatenate([w1, w1 * sides], axis=1)
    else:
        both = np.zeros((len(w1), 2 * hidden, closed.features.count))
        both[:, :hidden, closed.own] = w1
        both[:, hidden:, mirrored] = w1 * turned
    b1 = networks.b1.reshape(-1, hidden)
    return replace(
        networks,
        w1=both.reshape(len(w1) * 2 * hidden, -1),
        b1=np.concatenate([b1, b1], axis=1).ravel(),
        w2=np.concatenate([networks.w2, networks.w2[outputs]], axis=1) / 2,
        b2=(networks.b2 + networks.b2[outputs]) / 2,
    )
