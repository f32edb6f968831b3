"""Networks half of whose units look at the mirror image, as half the work: what a mirror leaves is added up once.

A symmetric model's units come in pairs: one looks at the face, its partner with the same weights at the mirror image.
Inputs that a mirror leaves add the same to both, inputs that it turns over the opposite. So each of the two sums is
made once, for the first of the pair: half the multiplications, and half the numbers in a file.
"""

from dataclasses import dataclass, replace

import numpy as np

from facegen.conventions import LANDMARK_COUNT, MIRRORED_LANDMARKS
from regress.exporters.answering import Answering
from regress.exporters.measures import Measures
from regress.runtime.features import mirrored_edges
from regress.runtime.networks import Denoising

STEP = 4
"""Inputs of each kind, and units, are a multiple of it, with idle ones if need be: loops take four at a time. Of 682
units C takes 1.6 times as long as of 684."""


@dataclass(frozen=True, kw_only=True)
class Fold:
    """Inputs made of features: ``features[first] + share features[second]``.

    Parameters
    ----------
    first, second : (A,) int64
    share : (A,) float64
        1, -1, or 0 for a feature that is its own mirror partner, and for idle inputs.
    """

    first: np.ndarray
    second: np.ndarray
    share: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Halves:
    """A set of networks whose units come in pairs.

    Parameters
    ----------
    even
        So many inputs, the first, are left by a mirror; the others are turned over.
    denoising
        With its axes in that order; None where there is none.
    fold
        What makes inputs of features; None where denoising does.
    hidden_weights : (U, A) float64
        Of the units that look at the face.
    hidden_bias : (2 U,) float64
        Of these, then of those that look at the mirror image.
    output_weights : (52, 2 U) float64
    output_bias : (52,) float64
    """

    even: int
    denoising: Denoising | None
    fold: Fold | None
    hidden_weights: np.ndarray
    hidden_bias: np.ndarray
    output_weights: np.ndarray
    output_bias: np.ndarray


def halves_of(answering: Answering) -> Halves | None:
    """The halves of a set of networks; None where its units do not come in pairs."""
    stacked = answering.stacked()
    counts = np.array([len(network.hidden_bias) for network in answering.networks])
    if (counts % 2).any():
        return None
    # in each network the first half of the units looks at the face
    place = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    at_face = place < np.repeat(counts // 2, counts)
    own, partner = stacked.hidden_weights[at_face], stacked.hidden_weights[~at_face]
    split = (
        _split_places(own, partner)
        if answering.denoising
        else _split_features(own, partner, answering.measures)
    )
    if split is None:
        return None
    fold, even, odd, weights = split
    order = np.concatenate([_padded(even), _padded(odd)])
    idle = order < 0
    units = np.concatenate([np.flatnonzero(at_face), np.flatnonzero(~at_face)])
    idle_units = -len(weights) % STEP
    sides = (2, len(weights))
    return Halves(
        even=len(_padded(even)),
        denoising=None if answering.denoising is None else _reordered(answering.denoising, order),
        fold=None if fold is None else _chosen(fold, order),
        hidden_weights=np.pad(np.where(idle, 0.0, weights[:, order]), [(0, idle_units), (0, 0)]),
        hidden_bias=np.pad(stacked.hidden_bias[units].reshape(sides), [(0, 0), (0, idle_units)]).ravel(),
        output_weights=np.pad(
            stacked.output_weights[:, units].reshape(-1, *sides), [(0, 0), (0, 0), (0, idle_units)]
        ).reshape(len(stacked.output_bias), -1),
        output_bias=stacked.output_bias,
    )


Split = tuple[Fold | None, np.ndarray, np.ndarray, np.ndarray]
"""What makes inputs of features, the inputs that a mirror leaves, those it turns over, and the weights on all."""


def _split_places(own: np.ndarray, partner: np.ndarray) -> Split | None:
    """Places along a filter's axes, which a mirror leaves or turns over as they are."""
    left, turned = (own == partner).all(axis=0), (own == -partner).all(axis=0)
    if not (left | turned).all():
        return None
    return None, np.flatnonzero(left), np.flatnonzero(~left), own


def _split_features(own: np.ndarray, partner: np.ndarray, measures: Measures) -> Split | None:
    """Sums and differences of each feature and of the one that it becomes in the mirror."""
    mirror, sign = _mirror_of(measures)
    if (mirror < 0).any() or not np.array_equal(partner[:, mirror] * sign, own):
        return None
    rows = np.arange(len(mirror))
    alone, paired = rows[mirror == rows], rows[mirror > rows]
    sums, differences = (
        Fold(first=paired, second=mirror[paired], share=direction * sign[paired]) for direction in (1.0, -1.0)
    )
    single = Fold(first=alone, second=alone, share=np.zeros(len(alone)))
    fold = Fold(
        first=np.concatenate([sums.first, differences.first, single.first]),
        second=np.concatenate([sums.second, differences.second, single.second]),
        share=np.concatenate([sums.share, differences.share, single.share]),
    )
    weights = (own[:, fold.first] + fold.share * own[:, fold.second]) / np.where(fold.share == 0, 1, 2)
    left = np.concatenate([np.ones(len(paired)), np.zeros(len(paired)), sign[alone] > 0]) > 0
    return fold, np.flatnonzero(left), np.flatnonzero(~left), weights


def _mirror_of(measures: Measures) -> tuple[np.ndarray, np.ndarray]:
    """Of each feature the one that it becomes in the mirror, -1 where there is none, and its sign."""
    if not measures.of_points:
        partners = mirrored_edges(measures.edges)
        return partners, np.ones(len(partners))
    partners = 2 * np.asarray(MIRRORED_LANDMARKS)[:, None] + [0, 1]
    return partners.ravel(), np.tile([-1.0, 1.0], LANDMARK_COUNT)


def _padded(rows: np.ndarray) -> np.ndarray:
    """Rows, and -1 for idle ones."""
    return np.concatenate([rows, np.full(-len(rows) % STEP, -1)])


def _chosen(fold: Fold, order: np.ndarray) -> Fold:
    return Fold(
        first=np.where(order < 0, 0, fold.first[order]),
        second=np.where(order < 0, 0, fold.second[order]),
        share=np.where(order < 0, 0.0, fold.share[order]),
    )


def _reordered(denoising: Denoising, order: np.ndarray) -> Denoising:
    """Axes in another order; idle ones are 0, and nothing is left along them."""
    idle = order < 0
    return replace(
        denoising,
        axes=np.where(idle[:, None], 0.0, denoising.axes[order]),
        offset=np.where(idle, 0.0, denoising.offset[order]),
        signal=np.where(idle, 1.0, denoising.signal[order]),
        surplus=np.where(idle, 0.0, denoising.surplus[order]),
    )
