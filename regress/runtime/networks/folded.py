"""Runs many small networks in one go, with everything linear folded into the weights."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from regress.runtime.networks.denoising import Denoising


@dataclass(frozen=True, kw_only=True)
class FoldedNetworks:
    """All networks as two matrix products and one tanh: ``y = W2 tanh(W1 x + b1) + b2``.

    Z-scores of inputs and targets, the PCA rotation and the halves of ``sigmoid(a) = (1 + tanh(a/2))/2`` are
    folded in.

    Parameters
    ----------
    w1 : (M*H, E) float64
        Hidden weights of M networks with H units each, network by network; they act on raw features, or on what
        ``denoising`` makes of them.
    b1 : (M*H,) float64
    w2 : (O, H) float64
        Output weights: row o acts on the H hidden units of network ``network_of_output[o]``.
    b2 : (O,) float64
    network_of_output : (O,) int64
    denoising
        What shrinks features before the networks see them; None where nothing does.
    """

    w1: np.ndarray
    b1: np.ndarray
    w2: np.ndarray
    b2: np.ndarray
    network_of_output: np.ndarray
    denoising: Denoising | None = None

    @property
    def hidden(self) -> int:
        """Hidden units of one network, H."""
        return self.w2.shape[1]

    @cached_property
    def block_w2(self) -> np.ndarray:
        """Output weights as one (O, M*H) matrix, zero outside each network's block: one product for all."""
        dense = np.zeros((len(self.b2), len(self.b1)))
        columns = self.network_of_output[:, None] * self.hidden + np.arange(self.hidden)
        np.put_along_axis(dense, columns, self.w2, axis=1)
        return dense


def shifted(networks: FoldedNetworks, origin: np.ndarray) -> FoldedNetworks:
    """The networks that act on features (E,) as these act on features less an origin."""
    if networks.denoising is not None:
        return replace(networks, denoising=networks.denoising.shifted(origin))
    return replace(networks, b1=networks.b1 - networks.w1 @ origin)


def evaluate(networks: FoldedNetworks, features: np.ndarray) -> np.ndarray:
    """Outputs of all networks.

    Parameters
    ----------
    features : (n, E) float64
        Raw features; rows of NaN give rows of NaN.

    Returns
    -------
    (n, O) float64
    """
    if networks.denoising is not None:
        features = networks.denoising.shrunk(features)
    hidden = features @ networks.w1.T
    hidden += networks.b1
    np.tanh(hidden, out=hidden)
    return hidden @ networks.block_w2.T + networks.b2
