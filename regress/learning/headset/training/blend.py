"""Blends the cameras' outputs, output by output."""

from dataclasses import dataclass

import torch

LEAST_MODULATION = 1e-4
"""A camera outside its part still answers where no other is left."""

_PRIOR = 1e-7
"""Share of the training mean: it counts where no camera is left."""


@dataclass(frozen=True)
class Blended:
    """Blended z-scores: mean and variance (n, outputs), and the cameras' shares (n, cameras, outputs)."""

    mean: torch.Tensor
    variance: torch.Tensor
    shares: torch.Tensor


def blend(
    means: torch.Tensor, log_variances: torch.Tensor, modulation: torch.Tensor, present: torch.Tensor
) -> Blended:
    """Weigh cameras by inverse variance, times the modulation of their parts (the second paper, eq. 2, 3 and 6).

    The variance is the shares' mean of the cameras' own: they err alike, so more of them are no surer.

    Parameters
    ----------
    means, log_variances : (n, cameras, outputs)
        Z-scores.
    modulation : (cameras, outputs)
        1 in a camera's part, elsewhere less.
    present : (n, cameras)
        0 where a camera is missing.
    """
    trust = present[..., None] * modulation * torch.exp(-log_variances)
    shares = trust / (trust.sum(dim=1, keepdim=True) + _PRIOR)
    left = 1 - shares.sum(dim=1)  # the training mean's own share; its variance is 1
    return Blended((shares * means).sum(dim=1), (shares * torch.exp(log_variances)).sum(dim=1) + left, shares)
