"""Computes the training loss (the second paper, eq. 4: blend, whole and part), on exact labels."""

from collections.abc import Sequence

import torch
from torch.nn import functional

from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.networks import Answer, HeadsetNetwork
from regress.runtime.headset.network.outputs import WEIGHTS

_SEAT = 0.1
"""Weight of the seat's cross-entropy."""

_NEAR = 0.2
"""Standardised distance of a place from the true one below which errors count squared: half a pixel of 64."""


def total_loss(
    network: HeadsetNetwork,
    answer: Answer,
    true: torch.Tensor,
    *,
    calibrated: torch.Tensor,
    same_seat: torch.Tensor,
    positions: Sequence[torch.Tensor],
    gram: torch.Tensor,
    recipe: HeadsetRecipe,
) -> torch.Tensor:
    """Loss of a batch.

    Parameters
    ----------
    true : (n, outputs)
        Z-scores.
    calibrated, same_seat : (n,)
        Of a training batch.
    positions : (n, P, 2) by camera
        Standardised; NaN where a point is not in the picture.
    gram : (52, 52)
        ``e @ gram @ e`` is the face's squared displacement by errors ``e`` of weights in z-scores, 1 where the
        training mean is said.
    """
    error = answer.blended.mean - true
    importance = torch.ones(error.shape[1])
    importance[WEIGHTS:] = recipe.gaze_loss
    importance = importance / importance.mean()
    loss = (importance * error.square()).mean()
    if recipe.geometry_loss:
        weights = error[:, : len(gram)]
        loss = loss + recipe.geometry_loss * ((weights @ gram) * weights).sum(dim=1).mean()
    own = answer.means - true[:, None]
    if network.part is not None and recipe.part_loss:
        share = torch.where(network.part, 1.0, recipe.part_loss_elsewhere)
        part = (importance * share * own.square()).mean()
        if recipe.geometry_loss:
            inside = (own * network.part)[..., : len(gram)]
            part = part + recipe.geometry_loss * ((inside @ gram) * inside).sum(dim=(1, 2)).mean()
        loss = loss + recipe.part_loss * part
    # Detached: a variance learns how wrong its mean is, and does not excuse it from getting better.
    log_variances = answer.log_variances
    loss = loss + 0.5 * (log_variances + own.detach().square() * torch.exp(-log_variances)).mean()
    if recipe.points_loss:
        loss = loss + recipe.points_loss * positions_loss(answer.positions, positions)
    if recipe.calibration:
        seat = functional.binary_cross_entropy_with_logits(answer.seat, same_seat, reduction="none")
        loss = loss + _SEAT * (seat * calibrated).sum() / calibrated.sum().clamp(min=1)
    return loss


def positions_loss(predicted: Sequence[torch.Tensor], true: Sequence[torch.Tensor]) -> torch.Tensor:
    """Mean over cameras of how far positions (n, P, 2) are from those that are known."""
    losses = []
    for one, other in zip(predicted, true, strict=True):
        shown = torch.isfinite(other)
        off = functional.smooth_l1_loss(one, torch.where(shown, other, 0.0), beta=_NEAR, reduction="none")
        losses.append((off * shown).sum() / shown.sum().clamp(min=1))
    return torch.stack(losses).mean()
