"""A second look at an iris: the picture's own pixels about where the first look found it.

The first look takes whole pictures, reduced; it finds a pupil within a pixel of the camera's, which is two degrees of
gaze. The second one halves that (docs/measurements/headset-networks.md).
"""

from collections.abc import Sequence

import torch
from torch import nn

from facegen.conventions import IRIS_POINTS, SIDES, VIEW_POINTS

_SIDE = 40
"""Samples along a side of what the second look sees."""

_MARGIN = 1.5
"""That side as a multiple of the usual iris' width."""

_CHANNELS = (16, 32, 32)
_HIDDEN = 96


def iris_columns(traced: Sequence[int]) -> tuple[tuple[int, ...], ...]:
    """For each eye whose pupil and whole iris are among the traced points, which they are: the pupil first."""
    columns = {VIEW_POINTS[index]: column for column, index in enumerate(traced)}
    eyes = [[f"{side}_pupil", *(f"{side}_iris_{place}" for place in range(IRIS_POINTS))] for side in SIDES]
    return tuple(tuple(columns[name] for name in eye) for eye in eyes if columns.keys() >= set(eye))


class Fovea(nn.Module):
    """From a picture and the rough place of an iris to the positions of its pupil and its outline.

    Pictures are in any units: the first normalisation takes their mean and spread.
    """

    def __init__(self) -> None:
        super().__init__()
        layers, channels, side = [], 1, _SIDE
        for step, wider in enumerate(_CHANNELS):
            kernel = 5 if step == 0 else 3
            layers += [
                nn.Conv2d(channels, wider, kernel, stride=2, padding=kernel // 2, bias=False),
                nn.BatchNorm2d(wider),
                nn.ReLU(),
            ]
            channels, side = wider, (side + 1) // 2
        self.convolutions = nn.Sequential(*layers)
        self.read = nn.Sequential(nn.Linear(channels * side**2, _HIDDEN), nn.ReLU())
        self.head = nn.Linear(_HIDDEN, 2 * (1 + IRIS_POINTS))
        self.register_buffer("line", (torch.arange(_SIDE) + 0.5) / _SIDE - 0.5)
        self.register_buffer("usual", torch.zeros(1 + IRIS_POINTS, 2))
        self.register_buffer("span", torch.tensor(0.4))

    def set_usual(self, positions: torch.Tensor) -> None:
        """Take the usual iris from positions (n, 9, 2), shares of the picture's side; NaN where it is not shown."""
        shown = positions[torch.isfinite(positions).all(dim=(1, 2))]
        if not len(shown):
            return
        self.usual.copy_((shown - center(shown)[:, None]).mean(dim=0))
        outline = self.usual[1:]
        self.span.copy_(_MARGIN * (outline.amax(dim=0) - outline.amin(dim=0)).max())

    def forward(self, pictures: torch.Tensor, first_look: torch.Tensor) -> torch.Tensor:
        """Positions (n, 9, 2), shares of the side, in pictures (n, size, size), from those of the first look.

        The first look learns nothing from the second.
        """
        middle = center(first_look.detach())
        across, down = (self._samples(place, pictures.shape[-1]) for place in middle.unbind(1))
        seen = (down @ pictures @ across.transpose(1, 2))[:, None]
        off = self.head(self.read(self.convolutions(seen).flatten(1))).view(-1, 1 + IRIS_POINTS, 2)
        return middle[:, None] + self.usual + self.span * off

    def _samples(self, middle: torch.Tensor, size: int) -> torch.Tensor:
        """(n, samples, size): how much each pixel of a side adds to each sample about ``middle`` (n,), linearly.

        Matrix products sample a picture as fast as ONNX's GridSample, which not every runtime has.
        """
        positions = ((middle[:, None] + self.span * self.line) * size - 0.5).clamp(0, size - 1)
        return torch.relu(1 - (positions[..., None] - torch.arange(size)).abs())


def center(positions: torch.Tensor) -> torch.Tensor:
    """Middle (n, 2) of the outlines of irises (n, 9, 2)."""
    return positions[:, 1:].mean(dim=1)
