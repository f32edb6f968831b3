"""What training makes small (the second paper, eq. 4: blend, whole and part), on exact labels."""

import torch
from torch.nn import functional

from regress.headset.recipe import HeadsetRecipe
from regress.headset.training.networks import Answer, HeadsetNetwork, ModularNetwork
from regress.headset.training.targets import WEIGHTS

_SEAT = 0.1
"""Weight of the seat's cross-entropy."""


def total_loss(
    network: HeadsetNetwork,
    answer: Answer,
    wanted: torch.Tensor,
    *,
    calibrated: torch.Tensor,
    same_seat: torch.Tensor,
    gram: torch.Tensor,
    recipe: HeadsetRecipe,
) -> torch.Tensor:
    """Loss of a batch.

    Parameters
    ----------
    wanted : (n, outputs)
        Z-scores.
    calibrated, same_seat : (n,)
        Of a training batch.
    gram : (52, 52)
        ``e @ gram @ e`` is the face's squared displacement by errors ``e`` of weights in z-scores, 1 where the
        training mean is said.
    """
    error = answer.blended.mean - wanted
    importance = torch.ones(error.shape[1])
    importance[WEIGHTS:] = recipe.gaze_loss
    importance = importance / importance.mean()
    loss = (importance * error.square()).mean()
    if recipe.geometry_loss:
        weights = error[:, : len(gram)]
        loss = loss + recipe.geometry_loss * ((weights @ gram) * weights).sum(dim=1).mean()
    own = answer.means - wanted[:, None]
    if isinstance(network, ModularNetwork) and recipe.part_loss:
        share = torch.where(network.part, 1.0, recipe.part_loss_elsewhere)
        loss = loss + recipe.part_loss * (importance * share * own.square()).mean()
    # Detached: a variance learns how wrong its mean is, and does not excuse it from getting better.
    log_variances = answer.log_variances
    loss = loss + 0.5 * (log_variances + own.detach().square() * torch.exp(-log_variances)).mean()
    if recipe.calibration:
        seat = functional.binary_cross_entropy_with_logits(answer.seat, same_seat, reduction="none")
        loss = loss + _SEAT * (seat * calibrated).sum() / calibrated.sum().clamp(min=1)
    return loss
