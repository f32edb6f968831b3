"""Randomises pictures photometrically, as another camera, lamp or lens would have made them."""

import numpy as np
import torch
from torch.nn import functional

_GAMMA, _GAIN, _RAMP, _VIGNETTE, _NOISE, _BLUR = 0.35, 0.25, 0.25, 0.25, 0.02, 0.5
"""Standard deviations at strength 1: of log gamma and log gain, of the ramp across the picture, of the darkening in
its corners, of noise (of full scale); the last is the share of pictures that are blurred. Gamma, gain and noise are
the trial's: they took the error on a shifted camera from 1.59 to 1.30 mm."""

_DOTLESS, _DOT_LEVEL = 0.3, 40 / 255
"""Share of pictures whose glints are taken off, and how far a dot stands above what is round it."""

_BLOBBED, _MOST_BLOBS, _BLOB_RADIUS = 0.3, 3, (0.01, 0.06)
"""Share of pictures with blobs of light, how many at most, and the range of their radii as shares of the width: real
near-eye cameras have one or two large glints, a bar or none, where a headset that is rendered has its own dots."""

_CLIPPED, _CLIP_PERCENT = 0.2, (70.0, 97.0)
"""Share of pictures that are saturated, and the range of percentiles at which: up to 28 % of the pixels of real
near-eye frames are."""

_PATCHED, _PATCH_CELLS, _PATCH_EDGE = 0.6, (4, 8), (0.5, 4.0)
"""Share of pictures with light and dark patches, of how many cells of noise across they are made, and how sharp their
edges are: rendered skin has one level, and networks take darker skin below shut lids for an eye."""


def draw_photometry(
    random: np.random.Generator,
    pictures: torch.Tensor,
    neutral: torch.Tensor,
    strength: float,
    plain: np.ndarray,
    patches: float = 0.0,
) -> tuple[torch.Tensor, torch.Tensor]:
    """Randomised pictures and neutral pictures (n, cameras, size, size), grey levels in [0, 255].

    A frame's camera treats its neutral picture alike, but for the noise and the places of blobs. Frames that are
    ``plain`` (n,) bool are given back as they are. ``patches`` is the standard deviation, in logarithms, of light and
    dark patches at strength 1; 0 draws none.
    """
    count, cameras, size, _ = pictures.shape

    def normal(*shape: int) -> torch.Tensor:
        return torch.from_numpy(
            random.standard_normal((count, cameras, *shape)).astype(np.float32) * strength
        )

    def some(share: float) -> torch.Tensor:
        return torch.from_numpy(random.random((count, cameras)) < share * min(strength, 1))

    gamma, gain = torch.exp(_GAMMA * normal(1, 1)), torch.exp(_GAIN * normal(1, 1))
    axis = torch.linspace(-1, 1, size)
    ramp = _RAMP * (normal(1, 1) * axis[None, :] + normal(1, 1) * axis[:, None])
    corner = _VIGNETTE * normal(1, 1).abs() * 0.5 * (axis[None, :] ** 2 + axis[:, None] ** 2)
    light = gain * torch.clamp(1 + ramp, min=0.2) * torch.clamp(1 - corner, min=0.2)
    soft, dotless, blobbed, clipped = (some(share) for share in (_BLUR, _DOTLESS, _BLOBBED, _CLIPPED))
    percent = torch.from_numpy(random.uniform(*_CLIP_PERCENT, (count, cameras)).astype(np.float32))
    sigma = _NOISE * torch.abs(normal(1, 1))
    # drawn only where they are asked for, so that trainings without them are those of before
    if patches and (patched := some(_PATCHED)).any():
        light = light.expand(count, cameras, size, size).clone()
        light[patched] *= draw_patches(random, int(patched.sum()), size, patches * strength)

    def treated(seen: torch.Tensor) -> torch.Tensor:
        seen = seen / 255
        if soft.any():
            seen[soft] = softened(seen[soft])
        if dotless.any():
            seen[dotless] = without_dots(seen[dotless])
        if clipped.any():
            seen[clipped] = saturated(seen[clipped], percent[clipped])
        seen = torch.pow(seen.clamp(min=1e-3), gamma) * light
        if blobbed.any():
            seen[blobbed] = torch.maximum(seen[blobbed], draw_blobs(random, int(blobbed.sum()), size))
        noise = torch.from_numpy(random.standard_normal(seen.shape, dtype=np.float32))
        return 255 * torch.clamp(seen + sigma * noise, 0, 1)

    as_they_are = torch.from_numpy(plain)[:, None, None, None]
    return torch.where(as_they_are, pictures, treated(pictures)), torch.where(
        as_they_are, neutral, treated(neutral)
    )


def softened(pictures: torch.Tensor) -> torch.Tensor:
    """Pictures (n, size, size) whose pixels are the means of three by three."""
    return functional.avg_pool2d(functional.pad(pictures, (1, 1, 1, 1), mode="replicate"), 3, stride=1)


def without_dots(pictures: torch.Tensor) -> torch.Tensor:
    """Pictures (n, size, size) in [0, 1] whose small bright dots are as dark as what is round them.

    Dots are where a morphological opening of five by five pixels (Serra, 1982) lies far below the picture.
    """
    eroded = -_highest(-pictures)
    opened = _highest(eroded)
    return torch.where(pictures - opened > _DOT_LEVEL, opened, pictures)


def _highest(pictures: torch.Tensor) -> torch.Tensor:
    """Highest values of five by five pixels, by rows and then by columns."""
    along = functional.max_pool2d(pictures, (1, 5), stride=1, padding=(0, 2))
    return functional.max_pool2d(along, (5, 1), stride=1, padding=(2, 0))


def saturated(pictures: torch.Tensor, percent: torch.Tensor) -> torch.Tensor:
    """Pictures (n, size, size) in [0, 1] cut off at a percentile (n,) of each, and lit to their former brightest."""
    flat = pictures[:, ::3, ::3].flatten(1).sort(dim=1).values
    places = (percent / 100 * (flat.shape[1] - 1)).long()
    level = flat.gather(1, places[:, None])[..., None]
    # twice at most: what was dark but for a few pixels does not become noise
    return torch.minimum(pictures, level) * (flat[:, -1:, None] / level.clamp(min=1e-3)).clamp(max=2.0)


def draw_patches(random: np.random.Generator, count: int, size: int, deviation: float) -> torch.Tensor:
    """Factors (count, size, size) of light and dark patches, from smooth to edged.

    A picture's factors lie between the exponentials of plus and minus a normal number of this standard deviation.
    """
    fewest, most = _PATCH_CELLS
    cells = int(random.integers(fewest, most + 1))
    level = random.standard_normal((count, 1, cells, cells))
    edge = np.exp(random.uniform(*np.log(_PATCH_EDGE), (count, 1, 1)))
    amount = deviation * np.abs(random.standard_normal((count, 1, 1)))
    level, edge, amount = (torch.from_numpy(drawn.astype(np.float32)) for drawn in (level, edge, amount))
    field = functional.interpolate(level, (size, size), mode="bicubic", align_corners=True)[:, 0]
    return torch.exp(amount * torch.tanh(edge * field))


def draw_blobs(random: np.random.Generator, count: int, size: int) -> torch.Tensor:
    """Light (count, size, size) in [0, 1] of one to three round or long blobs a picture, most near its middle."""
    shape = (count, _MOST_BLOBS)
    middle = np.clip(0.5 + 0.17 * random.standard_normal((2, *shape)), 0, 1)
    radius = np.exp(random.uniform(*np.log(_BLOB_RADIUS), (2, *shape)))
    angle = random.uniform(0, np.pi, shape)
    there = random.integers(1, _MOST_BLOBS + 1, (count, 1)) > np.arange(_MOST_BLOBS)
    axis = (torch.arange(size, dtype=torch.float32) + 0.5) / size

    def spread(values: np.ndarray) -> torch.Tensor:
        return torch.from_numpy(values.astype(np.float32))[..., None, None]

    across, down = axis - spread(middle[0]), axis[:, None] - spread(middle[1])
    cos, sin = spread(np.cos(angle)), spread(np.sin(angle))
    along, aside = cos * across + sin * down, cos * down - sin * across
    far = (along / spread(radius[0])) ** 2 + (aside / spread(radius[1])) ** 2
    return (spread(there) * torch.clamp(2 - far, 0, 1)).amax(dim=1)
