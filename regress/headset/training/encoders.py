"""A camera's encoder: pictures to the places of the face's points, and to a part code."""

import torch
from torch import nn

from regress.headset.training.tracers import Tracer

_CHANNELS = (16, 32, 48, 64)


class Encoder(nn.Module):
    """Four convolutions that halve the picture; a tracer of points beside them; a code of looks and one of places.

    Its input is the picture and, where a neutral picture is known, the difference from it. Without one the
    difference is zero, which is also what a neutral face gives: a switch says which is meant.

    Parameters
    ----------
    input_size
        Side of the pictures in pixels.
    code
        Numbers of each of the two codes.
    points
        How many points are traced; 0 leaves out the tracer and the code of places.
    """

    def __init__(self, input_size: int, code: int, points: int) -> None:
        super().__init__()
        layers, channels, sides = [], 2, []
        for step, wider in enumerate(_CHANNELS):
            kernel = 5 if step == 0 else 3
            layers.append(
                nn.Sequential(
                    nn.Conv2d(channels, wider, kernel, stride=2, padding=kernel // 2, bias=False),
                    nn.BatchNorm2d(wider),
                )
            )
            channels, input_size = wider, (input_size + 1) // 2
            sides.append(input_size)
        self.convolutions = nn.ModuleList(layers)
        self.switch = nn.Parameter(torch.zeros(_CHANNELS[0]))
        self.tracer = Tracer(_CHANNELS[1:], tuple(sides[1:]), points) if points else None
        self.looks = nn.Sequential(nn.Linear(channels * sides[-1] ** 2 + 1 + 2 * points, code), nn.ReLU())
        if points:
            self.shape = nn.Sequential(
                nn.Linear(2 * points + 1, code), nn.ReLU(), nn.Linear(code, code), nn.ReLU()
            )
        self.width = 2 * code if points else code
        self.register_buffer("scale", torch.tensor([0.0, 1.0, 1.0]))
        # on a CPU this order of memory trains a third faster than channels first
        self.to(memory_format=torch.channels_last)

    def set_scale(self, mean: float, std: float, difference_std: float) -> None:
        """Mean and standard deviation of the pictures and of differences from neutral ones, grey levels."""
        self.scale.copy_(torch.tensor([mean, std, difference_std]))

    def forward(
        self, pictures: torch.Tensor, neutral: torch.Tensor, calibrated: torch.Tensor
    ) -> tuple[torch.Tensor, torch.Tensor]:
        """Part codes (n, width) and places (n, P, 2), standardised, of pictures and neutral ones (n, size, size).

        Pictures are in grey levels; ``calibrated`` (n,) is 1 where the neutral one counts.
        """
        mean, std, difference_std = self.scale.unbind()
        known = calibrated[:, None, None]
        seen = torch.stack([(pictures - mean) / std, (pictures - neutral) / difference_std * known], dim=1)
        seen = seen.contiguous(memory_format=torch.channels_last)
        steps = []
        for step, layer in enumerate(self.convolutions):
            seen = layer(seen)
            if step == 0:
                seen = seen + calibrated[:, None, None, None] * self.switch[:, None, None]
            seen = torch.relu(seen)
            steps.append(seen)
        flat, known = seen.flatten(1), calibrated[:, None]
        if self.tracer is None:
            return self.looks(torch.cat([flat, known], dim=1)), flat.new_zeros(len(flat), 0, 2)
        places = self.tracer(steps[1:])
        told = torch.cat([places.flatten(1), known], dim=1)
        return torch.cat([self.looks(torch.cat([flat, told], dim=1)), self.shape(told)], dim=1), places
