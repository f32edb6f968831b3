"""Heat maps of the face's points: where lids, pupils, brows and lips lie in a picture.

Weights hang on where things are. Networks that learn weights alone remember the people they have seen instead: tracing
took blinks of unseen people from an R2 of .80 to .89 and gaze from 4.4 to 3.6 degrees
(docs/measurements/headset-networks.md).
"""

from collections.abc import Sequence

import torch
from torch import nn
from torch.nn import functional

_SPREAD = 0.05
"""Least standard deviation of a point's place, shares of the picture's side."""


class Tracer(nn.Module):
    """From features at a quarter, an eighth and a sixteenth of the picture's side to the positions of points.

    Coarse features are added to finer ones on the way back (Lin et al., "Feature Pyramid Networks", 2017); each point
    has a heat map at the finest, and lies at its mean (soft argmax; Sun et al., "Integral Human Pose Regression",
    2018).

    Parameters
    ----------
    channels, sides
        Of the features, finest first.
    points
        How many.
    """

    def __init__(self, channels: Sequence[int], sides: Sequence[int], points: int) -> None:
        super().__init__()
        self._sides = tuple(sides)
        finer = list(zip(channels[1:], channels[:-1], strict=True))
        self.lifts = nn.ModuleList([nn.Conv2d(coarse, fine, 1) for coarse, fine in finer])
        self.mixes = nn.ModuleList(
            [
                nn.Sequential(nn.Conv2d(fine, fine, 3, padding=1, bias=False), nn.BatchNorm2d(fine))
                for _, fine in finer
            ]
        )
        self.head = nn.Conv2d(channels[0], points, 1)
        line = (torch.arange(sides[0]) + 0.5) / sides[0]
        down, across = torch.meshgrid(line, line, indexing="ij")
        self.register_buffer("grid", torch.stack([across.flatten(), down.flatten()], dim=1))
        self.register_buffer("usual", torch.full((points, 2), 0.5))
        self.register_buffer("spread", torch.tensor(_SPREAD))

    def set_usual(self, positions: torch.Tensor) -> None:
        """Take means and spread from positions (n, P, 2), shares of the side; NaN beyond the picture."""
        mean = torch.nan_to_num(positions.nanmean(dim=0), nan=0.5)
        self.usual.copy_(mean)
        self.spread.copy_((positions - mean).square().nanmean().sqrt().nan_to_num(nan=0.0).clamp(min=_SPREAD))

    def standardised(self, positions: torch.Tensor) -> torch.Tensor:
        """Positions as `forward` gives them."""
        return (positions - self.usual) / self.spread

    def forward(self, features: Sequence[torch.Tensor]) -> torch.Tensor:
        """Standardised positions (n, P, 2) from features, finest first."""
        merged = features[-1]
        for step in range(len(self.lifts) - 1, -1, -1):
            side = self._sides[step]
            lifted = functional.interpolate(self.lifts[step](merged), size=(side, side))
            merged = torch.relu(self.mixes[step](lifted + features[step]))
        heat = torch.softmax(self.head(merged).flatten(2), dim=2)
        return self.standardised(heat @ self.grid)
