"""What training makes small (the second paper, eq. 4: blend, whole and part), on exact labels."""

from collections.abc import Sequence

import torch
from torch.nn import functional

from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.networks import Answer, HeadsetNetwork
from regress.runtime.headset.outputs import WEIGHTS

_SEAT = 0.1
"""Weight of the seat's cross-entropy."""

_NEAR = 0.2
"""Standardised distance of a place from the true one below which errors count squared: half a pixel of 64."""


def total_loss(
    network: HeadsetNetwork,
    answer: Answer,
    wanted: torch.Tensor,
    *,
    calibrated: torch.Tensor,
    same_seat: torch.Tensor,
    places: Sequence[torch.Tensor],
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
    places : (n, P, 2) by camera
        Standardised; NaN where a point is not in the picture.
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
        loss = loss + recipe.points_loss * places_loss(answer.places, places)
    if recipe.calibration:
        seat = functional.binary_cross_entropy_with_logits(answer.seat, same_seat, reduction="none")
        loss = loss + _SEAT * (seat * calibrated).sum() / calibrated.sum().clamp(min=1)
    return loss


def places_loss(found: Sequence[torch.Tensor], wanted: Sequence[torch.Tensor]) -> torch.Tensor:
    """Mean over cameras of how far places (n, P, 2) are from those that are known."""
    losses = []
    for one, other in zip(found, wanted, strict=True):
        known = torch.isfinite(other)
        off = functional.smooth_l1_loss(one, torch.where(known, other, 0.0), beta=_NEAR, reduction="none")
        losses.append((off * known).sum() / known.sum().clamp(min=1))
    return torch.stack(losses).mean()
