"""The modular network: each camera answers for itself, and the answers are blended."""

from collections.abc import Mapping, Sequence
from itertools import chain

import torch
from torch import nn

from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.blend import LEAST_MODULATION, blend
from regress.learning.headset.training.networks import Answer, Head, HeadsetNetwork
from regress.learning.headset.training.targets import part_mask
from regress.runtime.headset.network.parts import mirror_partner

_MIRRORED = " mirrored"
"""Behind a camera's name: what it tells cameras that are seen mirrored."""


class ModularNetwork(HeadsetNetwork):
    """Each camera gives every output with a variance; the outputs are blended."""

    def __init__(
        self, cameras: tuple[str, ...], recipe: HeadsetRecipe, points: Mapping[str, Sequence[int]]
    ) -> None:
        super().__init__(cameras, recipe, points)
        skip_inputs = recipe.skip * (len(cameras) - 1)
        self.heads = nn.ModuleDict(
            {name: Head(own.width + skip_inputs) for name, own in self.encoders.items()}
        )
        self.others = [_others(camera, self.owners) for camera in cameras]
        keys = dict.fromkeys(key for _, key in chain.from_iterable(self.others) if recipe.skip)
        self.tells = nn.ModuleDict(
            {key: nn.Linear(self.encoders[key.removesuffix(_MIRRORED)].width, recipe.skip) for key in keys}
        )
        part = torch.stack([torch.from_numpy(part_mask(camera)) for camera in cameras])
        self.register_buffer("part", part)
        self.register_buffer("modulation", torch.where(part, 1.0, max(recipe.modulation, LEAST_MODULATION)))

    def forward(
        self,
        pictures: Sequence[torch.Tensor],
        neutral: Sequence[torch.Tensor],
        present: torch.Tensor,
        calibrated: torch.Tensor,
        terms: torch.Tensor | None = None,
    ) -> Answer:
        """Answer to pictures and neutral ones (n, size, size) by camera, ``present`` (n, cameras); see `codes`."""
        means, log_variances, seat = [], [], 0.0
        codes, positions = self.codes(pictures, neutral, calibrated, terms)
        if self.tells:
            codes = self._with_heard(codes, present)
        for column, code in enumerate(codes):
            camera = self.cameras[column]
            owner = self.owners[camera]
            mean, log_variance, logit = self.heads[owner or camera](code)
            if owner is not None:
                mean = mean[:, self.mirror] * self.mirror_sign
                log_variance = log_variance[:, self.mirror]
            means.append(mean)
            log_variances.append(log_variance)
            seat = seat + present[:, column] * logit
        mean, log_variance = torch.stack(means, dim=1), torch.stack(log_variances, dim=1)
        blended = blend(mean, log_variance, self.modulation, present)
        return Answer(blended, mean, log_variance, seat, positions)

    def _with_heard(self, codes: list[torch.Tensor], present: torch.Tensor) -> list[torch.Tensor]:
        """Each camera's code, and behind it what the others tell (the second paper's skips); absent ones tell 0."""
        skips = {
            (column, key): present[:, column, None] * torch.relu(self.tells[key](codes[column]))
            for column, key in chain.from_iterable(self.others)
        }
        return [
            torch.cat([code, *(skips[source] for source in others)], dim=1)
            for code, others in zip(codes, self.others, strict=True)
        ]


def _others(camera: str, owners: Mapping[str, str | None]) -> list[tuple[int, str]]:
    """Columns of the other cameras with the keys of what they tell, a camera's partner first.

    A camera that is seen mirrored hears the mirror image of what its owner hears, in the same order: a camera on the
    other side instead of one on this, and of a camera without a partner, whose code knows left from right, what that
    tells of the mirrored face.
    """
    cameras = tuple(owners)
    swapped = {one: mirror_partner(one) if mirror_partner(one) in cameras else one for one in cameras}
    owner = owners[camera]
    order = sorted(cameras, key=lambda other: other != swapped[owner or camera])
    sources = []
    for other in order:
        if other == (owner or camera):
            continue
        source = other if owner is None else swapped[other]
        mirrored = owner is not None and source == other
        sources.append((cameras.index(source), (owners[source] or source) + (_MIRRORED if mirrored else "")))
    return sources
