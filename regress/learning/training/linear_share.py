"""Gives networks that are trained already a share of ridge regression on the same rows.

Networks bend where their training's heads bend, and another head bends elsewhere; a plane errs more at home and less
abroad, and their errors differ. A share of it in every answer is worth more than another network
(docs/measurements/real-recordings.md). A plane is a hidden unit that stays where tanh is straight, so nothing that
runs, saves or exports networks needs to know of it.
"""

from dataclasses import replace

import numpy as np

from regress.learning.training.baseline import Baseline
from regress.runtime.networks import FoldedNetworks

STRAIGHT = 0.05
"""What of a z-scored weight goes into tanh: 5 standard deviations come out 2 % short, and none beyond 20."""


def with_linear_share(networks: FoldedNetworks, ridge: Baseline, share: float) -> FoldedNetworks:
    """Networks that answer ``(1 - share) y + share y'``, where these answer y and ridge regression y'.

    Parameters
    ----------
    networks
        On raw features, undenoised; each gets a unit for every output that the widest has.
    ridge
        On the same features, before it is clipped.
    share
        0 to 1.
    """
    count = len(networks.b1) // networks.hidden
    place = np.array(
        [
            np.count_nonzero(networks.network_of_output[:output] == network)
            for output, network in enumerate(networks.network_of_output)
        ]
    )
    more = int(place.max()) + 1
    scores = ridge.normalisation
    plane = STRAIGHT * ridge.coefficients.T / scores.feature_std
    w1 = np.zeros((count, more, networks.w1.shape[1]))
    w1[networks.network_of_output, place] = plane
    b1 = np.zeros((count, more))
    b1[networks.network_of_output, place] = -plane @ scores.feature_mean
    w2 = np.zeros((len(networks.b2), more))
    w2[np.arange(len(w2)), place] = share * scores.target_std / STRAIGHT
    of_each = (count, networks.hidden)
    return replace(
        networks,
        w1=np.concatenate([networks.w1.reshape(*of_each, -1), w1], axis=1).reshape(-1, w1.shape[2]),
        b1=np.concatenate([networks.b1.reshape(of_each), b1], axis=1).ravel(),
        w2=np.concatenate([(1 - share) * networks.w2, w2], axis=1),
        b2=(1 - share) * networks.b2 + share * scores.target_mean,
    )
