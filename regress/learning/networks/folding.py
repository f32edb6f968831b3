"""Folds everything linear around a trained network into its weights."""

import numpy as np

from regress.learning.networks.least_squares import Layout
from regress.runtime.networks.folded import FoldedNetworks


def fold(
    layout: Layout,
    parameters: np.ndarray,
    *,
    outputs: tuple[int, ...],
    rotation: np.ndarray,
    input_mean: np.ndarray,
    input_std: np.ndarray,
    target_mean: np.ndarray,
    target_std: np.ndarray,
) -> FoldedNetworks:
    """Networks that act on raw features and give raw targets.

    With ``s(a) = (1 + tanh(a/2)) / 2``: half of W1, half of W2, and half of W2's sum in the output bias.

    Parameters
    ----------
    layout, parameters : (M, P)
        Trained networks on z-scored features in principal axes.
    outputs
        Number of outputs of each network, at most ``layout.outputs``.
    rotation : (E, A)
        Columns are the principal axes.
    input_mean, input_std : (E,)
    target_mean, target_std : (O,)
        In the networks' order, O the sum of ``outputs``.

    Returns
    -------
    FoldedNetworks
        In float64.
    """
    w1, w2 = layout.split(parameters.astype(np.float64))
    on_features = (w1[:, :, :-1] @ rotation.T) / input_std
    bias = w1[:, :, -1] - on_features @ input_mean
    network_of_output = np.repeat(np.arange(len(outputs)), outputs)
    rows = np.concatenate([w2[network, :count] for network, count in enumerate(outputs)])
    return FoldedNetworks(
        w1=on_features.reshape(-1, len(rotation)) / 2,
        b1=bias.reshape(-1) / 2,
        w2=rows[:, :-1] / 2 * target_std[:, None],
        b2=(rows[:, -1] + rows[:, :-1].sum(axis=1) / 2) * target_std + target_mean,
        network_of_output=network_of_output,
    )
