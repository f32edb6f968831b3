"""Encodes a camera's pictures: into positions of the face's points, and into a part code."""

from collections.abc import Sequence

import torch
from torch import nn

from facegen.conventions import CAMERA_TERMS
from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.foveas import Fovea, iris_columns
from regress.learning.headset.training.resampling import linear_matrix
from regress.learning.headset.training.residuals import Residual
from regress.learning.headset.training.tracers import Tracer

_CHANNELS = (16, 32, 48, 64)


class Encoder(nn.Module):
    """Four convolutions that halve the picture; a tracer of points beside them; a code of looks and one of positions.

    Residual blocks may stand behind all convolutions but the first. A neutral picture goes through the same layers and
    the same tracer, and the code reads what differs: a lid that hangs half shut is a blink in one face and rest in
    another. So a frame is seen in the same way with a neutral picture and without. All this sees the picture reduced;
    irises are then looked at again in all its pixels.

    Parameters
    ----------
    recipe
        Sizes.
    traced
        Which of ``VIEW_POINTS`` are traced; none leaves out the tracer and the code of positions.
    """

    def __init__(self, recipe: HeadsetRecipe, traced: Sequence[int]) -> None:
        super().__init__()
        input_size, code, points = recipe.input_size, recipe.code, len(traced)
        self.told = len(CAMERA_TERMS) + 1 if recipe.camera_terms else 0
        reduction = linear_matrix(recipe.square_size, input_size)
        self.register_buffer("reduction", torch.from_numpy(reduction.astype("float32")))
        layers, channels, sides = [], 1, []
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
        # none behind the first: at half the picture's side they would take longer than all others
        self.blocks = nn.ModuleList(
            [
                nn.Sequential(*(Residual(wide) for _ in range(recipe.blocks if step else 0)))
                for step, wide in enumerate(_CHANNELS)
            ]
        )
        irises = iris_columns(traced) if recipe.second_look else ()
        # positions, those of irises again, how far from the neutral picture's, whether there is one, and the camera
        position_inputs = 4 * points + sum(2 * len(columns) for columns in irises) + 1 + self.told
        self.looks = nn.Sequential(
            nn.Linear(2 * channels * sides[-1] ** 2 + position_inputs, code), nn.ReLU()
        )
        self.tracer = None
        if points:
            self.tracer = Tracer(_CHANNELS[1:], tuple(sides[1:]), points)
            self.irises = irises
            self.foveas = nn.ModuleList([Fovea() for _ in self.irises])
            self.shape = nn.Sequential(
                nn.Linear(position_inputs, code), nn.ReLU(), nn.Linear(code, code), nn.ReLU()
            )
        self.width = 2 * code if points else code
        self.register_buffer("scale", torch.tensor([0.0, 1.0]))
        # on a CPU this order of memory trains a third faster than channels first
        self.to(memory_format=torch.channels_last)

    def set_scale(self, mean: float, std: float) -> None:
        """Mean and standard deviation of the pictures, grey levels."""
        self.scale.copy_(torch.tensor([mean, std]))

    def set_usual(self, positions: torch.Tensor) -> None:
        """Take usual positions from those (n, P, 2) of training pictures, shares of the side; NaN where not shown."""
        if self.tracer is None:
            return
        self.tracer.set_usual(positions)
        for fovea, columns in zip(self.foveas, self.irises, strict=True):
            fovea.set_usual(positions[:, columns])

    def standardised(self, positions: torch.Tensor) -> torch.Tensor:
        """Positions (n, P + 9 irises, 2) as `forward` gives them: all points traced, then irises looked at again."""
        if self.tracer is None:
            return positions
        again = [self.tracer.standardised(positions)[:, columns] for columns in self.irises]
        return torch.cat([self.tracer.standardised(positions), *again], dim=1)

    def shares(self, positions: torch.Tensor) -> torch.Tensor:
        """Positions (n, P, 2), shares of the side, from those of `forward`; irises where the second look saw them."""
        best, column_again = list(range(len(self.tracer.usual))), len(self.tracer.usual)
        for columns in self.irises:
            for column in columns:
                best[column], column_again = column_again, column_again + 1
        return positions[:, best] * self.tracer.spread + self.tracer.usual

    def forward(
        self, pictures: torch.Tensor, neutral: torch.Tensor, calibrated: torch.Tensor, terms: torch.Tensor
    ) -> tuple[torch.Tensor, torch.Tensor]:
        """Part codes (n, width) and standardised positions of pictures and neutral ones (n, size, size).

        Pictures are in grey levels; ``calibrated`` (n,) is 1 where the neutral one counts, ``terms`` (n, 15 or 0) are
        those of the camera (``Batch``).
        """
        has_neutral = calibrated[:, None]
        # without a neutral picture the frame stands in for it: batch statistics see no black ones
        before = torch.where(has_neutral[..., None] > 0, neutral, pictures)
        small, small_before = (self.reduction @ seen @ self.reduction.T for seen in (pictures, before))
        features, features_before = self._features(small), self._features(small_before)
        flat = features[-1].flatten(1)
        changed = (flat - features_before[-1].flatten(1)) * has_neutral
        if self.tracer is None:
            seen = [flat, changed, has_neutral, *self._heard(terms)]
            return self.looks(torch.cat(seen, dim=1)), flat.new_zeros(len(flat), 0, 2)
        positions = self.tracer(features[1:])
        rest = self.tracer(features_before[1:])
        moved = (positions - rest.detach()).flatten(1) * has_neutral  # learns to trace from the frame itself
        again = [
            self._look_again(fovea, pictures, positions[:, columns], columns)
            for fovea, columns in zip(self.foveas, self.irises, strict=True)
        ]
        seen_at = torch.cat(
            [
                positions.flatten(1),
                *(one.flatten(1) for one in again),
                moved,
                has_neutral,
                *self._heard(terms),
            ],
            dim=1,
        )
        code = torch.cat([self.looks(torch.cat([flat, changed, seen_at], dim=1)), self.shape(seen_at)], dim=1)
        return code, torch.cat([positions, *again], dim=1)

    def _heard(self, terms: torch.Tensor) -> list[torch.Tensor]:
        """What is told of the camera; nothing for a network that does not listen, whose graph stays what it was."""
        return [terms] if self.told else []

    def _look_again(
        self, fovea: Fovea, pictures: torch.Tensor, positions: torch.Tensor, columns: Sequence[int]
    ) -> torch.Tensor:
        usual, spread = self.tracer.usual[list(columns)], self.tracer.spread
        return (fovea(pictures, positions * spread + usual) - usual) / spread

    def _features(self, pictures: torch.Tensor) -> list[torch.Tensor]:
        """Features after each convolution, finest first."""
        mean, std = self.scale.unbind()
        feature = ((pictures - mean) / std)[:, None]
        features = []
        for layer, blocks in zip(self.convolutions, self.blocks, strict=True):
            feature = blocks(torch.relu(layer(feature)))
            features.append(feature)
        return features
