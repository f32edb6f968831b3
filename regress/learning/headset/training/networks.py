"""The modular and the holistic network: part codes to outputs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

import torch
from torch import nn

from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.blend import LEAST_MODULATION, Blended, blend
from regress.learning.headset.training.encoders import Encoder
from regress.learning.headset.training.targets import part_mask
from regress.runtime.headset.outputs import MIRROR, MIRROR_SIGN, OUTPUTS
from regress.runtime.headset.parts import encoder_owners, mirror_partner

_COUNT = len(OUTPUTS)
_MIRRORED = " mirrored"
"""Behind a camera's name: what it tells cameras that are seen mirrored."""
_LOG_VARIANCE = (-6.0, 3.0)
"""Of z-scores: a standard deviation of .05 to 4.5 times the training one."""


@dataclass(frozen=True)
class Answer:
    """Z-scores of n frames.

    Parameters
    ----------
    blended
        The network's answer.
    means, log_variances : (n, cameras, outputs), or (n, 1, outputs) of a holistic network
        What each camera says for itself.
    seat : (n,)
        Logit that the neutral pictures come from the frame's own seat.
    places : tuple of (n, P, 2)
        By camera, where the points that its encoder traces lie in what that sees, standardised.
    """

    blended: Blended
    means: torch.Tensor
    log_variances: torch.Tensor
    seat: torch.Tensor
    places: tuple[torch.Tensor, ...]


class _Head(nn.Module):
    """Means, log variances and the seat's logit from a code.

    Variances read the code and do not shape it: shaping cost 2 % of the geometry error with a neutral picture.
    """

    def __init__(self, code: int) -> None:
        super().__init__()
        self.means, self.log_variances = nn.Linear(code, _COUNT), nn.Linear(code, _COUNT)
        self.seat = nn.Linear(code, 1)

    def forward(self, code: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        log_variances = self.log_variances(code.detach()).clamp(*_LOG_VARIANCE)
        return self.means(code), log_variances, self.seat(code)[:, 0]


class HeadsetNetwork(nn.Module):
    """Encoders of all cameras; a camera with a partner on the other side shares its encoder, mirrored.

    Parameters
    ----------
    cameras
        Names, in order.
    recipe
        Sizes and modulation.
    points
        Which of ``VIEW_POINTS`` each encoder traces, by the camera that owns it.
    """

    def __init__(
        self, cameras: tuple[str, ...], recipe: HeadsetRecipe, points: Mapping[str, Sequence[int]]
    ) -> None:
        super().__init__()
        self.owners = encoder_owners(cameras)
        self.cameras = cameras
        own = [camera for camera in cameras if self.owners[camera] is None]
        self.encoders = nn.ModuleDict({camera: Encoder(recipe, points[camera]) for camera in own})
        self.register_buffer("mirror", torch.from_numpy(MIRROR.copy()))
        self.register_buffer("mirror_sign", torch.from_numpy(MIRROR_SIGN.copy()))

    def encoder(self, camera: str) -> Encoder:
        """The encoder that sees a camera's pictures."""
        return self.encoders[self.owners[camera] or camera]

    def codes(
        self, pictures: Sequence[torch.Tensor], neutral: Sequence[torch.Tensor], calibrated: torch.Tensor
    ) -> tuple[list[torch.Tensor], tuple[torch.Tensor, ...]]:
        """Part codes (n, width) and places (n, P, 2) by camera, from grey pictures (n, size, size) by camera.

        Cameras that share an encoder go through it together.
        """
        codes: dict[str, torch.Tensor] = {}
        places: dict[str, torch.Tensor] = {}
        for name, encoder in self.encoders.items():
            users = [camera for camera in self.cameras if camera == name or self.owners[camera] == name]
            columns = [self.cameras.index(camera) for camera in users]
            seen, rest = (torch.cat([given[column] for column in columns]) for given in (pictures, neutral))
            found = encoder(seen, rest, calibrated.repeat(len(users)))
            for said, all_said in zip((codes, places), found, strict=True):
                said |= zip(users, all_said.unflatten(0, (len(users), -1)).unbind(), strict=True)
        return [codes[camera] for camera in self.cameras], tuple(places[camera] for camera in self.cameras)


class ModularNetwork(HeadsetNetwork):
    """Each camera says every output with a variance; the answers are blended."""

    def __init__(
        self, cameras: tuple[str, ...], recipe: HeadsetRecipe, points: Mapping[str, Sequence[int]]
    ) -> None:
        super().__init__(cameras, recipe, points)
        heard = recipe.skip * (len(cameras) - 1)
        self.heads = nn.ModuleDict({name: _Head(own.width + heard) for name, own in self.encoders.items()})
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
    ) -> Answer:
        """Answer to pictures and neutral ones (n, size, size) by camera, ``present`` (n, cameras)."""
        means, log_variances, seat = [], [], 0.0
        codes, places = self.codes(pictures, neutral, calibrated)
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
        return Answer(blended, mean, log_variance, seat, places)

    def _with_heard(self, codes: list[torch.Tensor], present: torch.Tensor) -> list[torch.Tensor]:
        """Each camera's code, and behind it what the others tell (the second paper's skips); absent ones tell 0."""
        told = {
            (column, key): present[:, column, None] * torch.relu(self.tells[key](codes[column]))
            for column, key in chain.from_iterable(self.others)
        }
        return [
            torch.cat([code, *(told[said] for said in others)], dim=1)
            for code, others in zip(codes, self.others, strict=True)
        ]


class HolisticNetwork(HeadsetNetwork):
    """All part codes together go through one hidden layer; a learned code stands in for a missing camera's."""

    def __init__(
        self, cameras: tuple[str, ...], recipe: HeadsetRecipe, points: Mapping[str, Sequence[int]]
    ) -> None:
        super().__init__(cameras, recipe, points)
        widths = [self.encoder(camera).width for camera in cameras]
        self.absent = nn.ParameterList([nn.Parameter(torch.zeros(width)) for width in widths])
        self.hidden = nn.Sequential(nn.Linear(sum(widths), recipe.hidden), nn.ReLU())
        self.head = _Head(recipe.hidden)

    def forward(
        self,
        pictures: Sequence[torch.Tensor],
        neutral: Sequence[torch.Tensor],
        present: torch.Tensor,
        calibrated: torch.Tensor,
    ) -> Answer:
        """Answer to pictures and neutral ones (n, size, size) by camera, ``present`` (n, cameras)."""
        codes, places = self.codes(pictures, neutral, calibrated)
        heard = [
            torch.lerp(absent, code, here[:, None])
            for absent, code, here in zip(self.absent, codes, present.unbind(1), strict=True)
        ]
        mean, log_variance, logit = self.head(self.hidden(torch.cat(heard, dim=1)))
        shares = (torch.ones_like(present) / len(self.cameras))[..., None].expand(-1, -1, _COUNT)
        blended = Blended(mean, torch.exp(log_variance), shares)
        return Answer(blended, mean[:, None], log_variance[:, None], logit, places)


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
    found = []
    for other in order:
        if other == (owner or camera):
            continue
        heard = other if owner is None else swapped[other]
        mirrored = owner is not None and heard == other
        found.append((cameras.index(heard), (owners[heard] or heard) + (_MIRRORED if mirrored else "")))
    return found


NETWORKS: dict[str, type[HeadsetNetwork]] = {"modular": ModularNetwork, "holistic": HolisticNetwork}
