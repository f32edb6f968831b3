"""Defines what every headset network has: encoders of its cameras, heads that read codes, and its answer."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pkgutil import resolve_name

import torch
from torch import nn

from regress.learning.headset.architectures import ARCHITECTURES
from regress.learning.headset.recipe import HeadsetRecipe
from regress.learning.headset.training.blend import Blended
from regress.learning.headset.training.encoders import Encoder
from regress.runtime.headset.network.outputs import MIRROR, MIRROR_SIGN, OUTPUTS
from regress.runtime.headset.network.parts import encoder_owners

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
    positions : tuple of (n, P, 2)
        By camera, where the points that its encoder traces lie in what that sees, standardised.
    """

    blended: Blended
    means: torch.Tensor
    log_variances: torch.Tensor
    seat: torch.Tensor
    positions: tuple[torch.Tensor, ...]


class Head(nn.Module):
    """Means, log variances and the seat's logit from a code.

    Variances read the code and do not shape it: shaping cost 2 % of the geometry error with a neutral picture.
    """

    def __init__(self, code: int) -> None:
        super().__init__()
        self.means, self.log_variances = nn.Linear(code, len(OUTPUTS)), nn.Linear(code, len(OUTPUTS))
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

    Attributes
    ----------
    part : (cameras, outputs) bool or None
        Outputs of each camera's part, where cameras answer for themselves.
    """

    def __init__(
        self, cameras: tuple[str, ...], recipe: HeadsetRecipe, points: Mapping[str, Sequence[int]]
    ) -> None:
        super().__init__()
        self.owners = encoder_owners(cameras)
        self.cameras = cameras
        own = [camera for camera in cameras if self.owners[camera] is None]
        self.encoders = nn.ModuleDict({camera: Encoder(recipe, points[camera]) for camera in own})
        self.register_buffer("part", None)
        self.register_buffer("mirror", torch.from_numpy(MIRROR.copy()))
        self.register_buffer("mirror_sign", torch.from_numpy(MIRROR_SIGN.copy()))

    def encoder(self, camera: str) -> Encoder:
        """The encoder that sees a camera's pictures."""
        return self.encoders[self.owners[camera] or camera]

    def codes(
        self,
        pictures: Sequence[torch.Tensor],
        neutral: Sequence[torch.Tensor],
        calibrated: torch.Tensor,
        terms: torch.Tensor | None,
    ) -> tuple[list[torch.Tensor], tuple[torch.Tensor, ...]]:
        """Part codes (n, width) and positions (n, P, 2) by camera, from grey pictures (n, size, size) by camera.

        ``terms`` (n, cameras, 15) are what is told of the cameras, as their encoders see them; None tells nothing.

        Cameras that share an encoder go through it together.
        """
        if terms is None:
            told = next(iter(self.encoders.values())).told
            terms = calibrated.new_zeros(len(calibrated), len(self.cameras), told)
        codes: dict[str, torch.Tensor] = {}
        positions: dict[str, torch.Tensor] = {}
        for name, encoder in self.encoders.items():
            users = [camera for camera in self.cameras if camera == name or self.owners[camera] == name]
            columns = [self.cameras.index(camera) for camera in users]
            seen, rest = (torch.cat([given[column] for column in columns]) for given in (pictures, neutral))
            told = torch.cat([terms[:, column] for column in columns])
            encoded = encoder(seen, rest, calibrated.repeat(len(users)), told)
            for by_camera, values in zip((codes, positions), encoded, strict=True):
                by_camera |= zip(users, values.unflatten(0, (len(users), -1)).unbind(), strict=True)
        return [codes[camera] for camera in self.cameras], tuple(positions[camera] for camera in self.cameras)


def network_of(architecture: str) -> type[HeadsetNetwork]:
    """The network of an architecture's entry in ``ARCHITECTURES``."""
    return resolve_name(ARCHITECTURES[architecture].network)
