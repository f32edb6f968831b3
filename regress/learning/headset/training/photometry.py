"""Randomises pictures photometrically, as another camera, lamp or lens would have made them."""

import numpy as np
import torch
from torch.nn import functional

_GAMMA, _GAIN, _RAMP, _VIGNETTE, _NOISE, _BLUR = 0.35, 0.25, 0.25, 0.25, 0.02, 0.5
"""Standard deviations at strength 1: of log gamma and log gain, of the ramp across the picture, of the darkening in
its corners, of noise (of full scale); the last is the share of pictures that are blurred. Gamma, gain and noise are
the trial's: they took the error on a shifted camera from 1.59 to 1.30 mm."""


def draw_photometry(
    random: np.random.Generator,
    pictures: torch.Tensor,
    neutral: torch.Tensor,
    strength: float,
    plain: np.ndarray,
) -> tuple[torch.Tensor, torch.Tensor]:
    """Randomised pictures and neutral pictures (n, cameras, size, size), grey levels in [0, 255].

    A frame's camera treats its neutral picture alike, but for the noise. Frames that are ``plain`` (n,) bool are given
    back as they are.
    """
    count, cameras, size, _ = pictures.shape

    def normal(*shape: int) -> torch.Tensor:
        return torch.from_numpy(
            random.standard_normal((count, cameras, *shape)).astype(np.float32) * strength
        )

    gamma, gain = torch.exp(_GAMMA * normal(1, 1)), torch.exp(_GAIN * normal(1, 1))
    axis = torch.linspace(-1, 1, size)
    ramp = _RAMP * (normal(1, 1) * axis[None, :] + normal(1, 1) * axis[:, None])
    corner = _VIGNETTE * normal(1, 1).abs() * 0.5 * (axis[None, :] ** 2 + axis[:, None] ** 2)
    light = gain * torch.clamp(1 + ramp, min=0.2) * torch.clamp(1 - corner, min=0.2)
    blurred = torch.from_numpy(
        (random.random((count, cameras, 1, 1)) < _BLUR * min(strength, 1)).astype(np.float32)
    )
    sigma = _NOISE * torch.abs(normal(1, 1))

    def treated(seen: torch.Tensor) -> torch.Tensor:
        soft = functional.avg_pool2d(functional.pad(seen, (1, 1, 1, 1), mode="replicate"), 3, stride=1)
        seen = (blurred * soft + (1 - blurred) * seen) / 255
        noise = torch.from_numpy(random.standard_normal(seen.shape).astype(np.float32))
        return 255 * torch.clamp(torch.pow(seen.clamp(min=1e-3), gamma) * light + sigma * noise, 0, 1)

    as_they_are = torch.from_numpy(plain)[:, None, None, None]
    return torch.where(as_they_are, pictures, treated(pictures)), torch.where(
        as_they_are, neutral, treated(neutral)
    )
