"""A camera's encoder: pictures to a part code."""

import torch
from torch import nn

_CHANNELS = (16, 32, 48, 64)


class Encoder(nn.Module):
    """Four convolutions that halve the picture, and a fully connected layer.

    Its input is the picture and, where a neutral picture is known, the difference from it. Without one the
    difference is zero, which is also what a neutral face gives: a switch says which is meant.

    Parameters
    ----------
    input_size
        Side of the pictures in pixels.
    code
        Numbers of the part code.
    """

    def __init__(self, input_size: int, code: int) -> None:
        super().__init__()
        layers, channels, side = [], 2, input_size
        for step, wider in enumerate(_CHANNELS):
            kernel = 5 if step == 0 else 3
            layers.append(
                nn.Sequential(
                    nn.Conv2d(channels, wider, kernel, stride=2, padding=kernel // 2, bias=False),
                    nn.BatchNorm2d(wider),
                )
            )
            channels, side = wider, (side + 1) // 2
        self.convolutions = nn.ModuleList(layers)
        self.switch = nn.Parameter(torch.zeros(_CHANNELS[0]))
        self.code = nn.Sequential(nn.Linear(channels * side * side + 1, code), nn.ReLU())
        self.register_buffer("scale", torch.tensor([0.0, 1.0, 1.0]))
        # on a CPU this order of memory trains a third faster than channels first
        self.convolutions.to(memory_format=torch.channels_last)

    def set_scale(self, mean: float, std: float, difference_std: float) -> None:
        """Mean and standard deviation of the pictures and of differences from neutral ones, grey levels."""
        self.scale.copy_(torch.tensor([mean, std, difference_std]))

    def forward(
        self, pictures: torch.Tensor, neutral: torch.Tensor, calibrated: torch.Tensor
    ) -> torch.Tensor:
        """Part codes (n, code) of pictures and neutral pictures (n, size, size), grey levels.

        ``calibrated`` (n,) is 1 where the neutral picture counts.
        """
        mean, std, difference_std = self.scale.unbind()
        known = calibrated[:, None, None]
        seen = torch.stack([(pictures - mean) / std, (pictures - neutral) / difference_std * known], dim=1)
        seen = seen.contiguous(memory_format=torch.channels_last)
        for step, layer in enumerate(self.convolutions):
            seen = layer(seen)
            if step == 0:
                seen = seen + calibrated[:, None, None, None] * self.switch[:, None, None]
            seen = torch.relu(seen)
        return self.code(torch.cat([seen.flatten(1), calibrated[:, None]], dim=1))
