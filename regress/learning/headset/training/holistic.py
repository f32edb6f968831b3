"""The holistic network: one hidden layer reads the codes of all cameras."""

from collections.abc import Mapping, Sequence

import torch
from torch import nn

from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.blend import Blended
from regress.learning.headset.training.networks import Answer, Head, HeadsetNetwork
from regress.runtime.headset.network.outputs import OUTPUTS


class HolisticNetwork(HeadsetNetwork):
    """All part codes together go through one hidden layer; a learned code stands in for a missing camera's."""

    def __init__(
        self, cameras: tuple[str, ...], recipe: HeadsetRecipe, points: Mapping[str, Sequence[int]]
    ) -> None:
        super().__init__(cameras, recipe, points)
        widths = [self.encoder(camera).width for camera in cameras]
        self.absent = nn.ParameterList([nn.Parameter(torch.zeros(width)) for width in widths])
        self.hidden = nn.Sequential(nn.Linear(sum(widths), recipe.hidden), nn.ReLU())
        self.head = Head(recipe.hidden)

    def forward(
        self,
        pictures: Sequence[torch.Tensor],
        neutral: Sequence[torch.Tensor],
        present: torch.Tensor,
        calibrated: torch.Tensor,
        terms: torch.Tensor | None = None,
    ) -> Answer:
        """Answer to pictures and neutral ones (n, size, size) by camera, ``present`` (n, cameras); see `codes`."""
        codes, positions = self.codes(pictures, neutral, calibrated, terms)
        seen = [
            torch.lerp(absent, code, here[:, None])
            for absent, code, here in zip(self.absent, codes, present.unbind(1), strict=True)
        ]
        mean, log_variance, logit = self.head(self.hidden(torch.cat(seen, dim=1)))
        shares = (torch.ones_like(present) / len(self.cameras))[..., None].expand(-1, -1, len(OUTPUTS))
        blended = Blended(mean, torch.exp(log_variance), shares)
        return Answer(blended, mean[:, None], log_variance[:, None], logit, positions)
