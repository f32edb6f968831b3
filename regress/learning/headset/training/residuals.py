"""Residual blocks: layers by which an encoder is deeper, and which begin as nothing."""

import torch
from torch import nn


class Residual(nn.Module):
    """Two convolutions whose answer is added to what they see (He et al., "Deep residual learning", 2016, fig. 2).

    Their last scale begins as 0: a deeper network can so go on from a shallower one, and first answers as that does.
    """

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.convolutions = nn.Sequential(
            nn.Conv2d(channels, channels, 3, padding=1, bias=False),
            nn.BatchNorm2d(channels),
            nn.ReLU(),
            nn.Conv2d(channels, channels, 3, padding=1, bias=False),
            nn.BatchNorm2d(channels),
        )
        nn.init.zeros_(self.convolutions[-1].weight)

    def forward(self, features: torch.Tensor) -> torch.Tensor:
        """Features (n, channels, h, w), none below 0, as they come in."""
        return torch.relu(features + self.convolutions(features))


def residual_names(network: nn.Module) -> set[str]:
    """Names of all convolutions in blocks."""
    return {
        f"{name}.{own}"
        for name, block in network.named_modules()
        if isinstance(block, Residual)
        for own, layer in block.named_modules()
        if isinstance(layer, nn.Conv2d)
    }
