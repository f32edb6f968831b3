"""Computes what a lens does to light: the share that gets through, across the picture, and the blur out of focus."""

import numpy as np

from facegen.headsets import HeadsetCamera

SHARP_PX = 0.1
"""A blur of this standard deviation leaves a pixel 99 % of its light."""


def transmission(camera: HeadsetCamera) -> np.ndarray:
    """(h, w) shares, 0 to 1, of the light that vignette and aperture leave."""
    v, u = np.mgrid[0 : camera.height, 0 : camera.width].astype(np.float64)
    squared = (u - camera.cx) ** 2 + (v - camera.cy) ** 2
    left = 1.0 - camera.lens.vignette * squared / squared.max()
    # the rim's edge falls within a pixel
    return left * np.clip(camera.inside_aperture_px(np.stack([u, v], axis=-1)) + 0.5, 0.0, 1.0)


def defocused(light: np.ndarray, camera: HeadsetCamera) -> np.ndarray:
    """Light (h, w) spread by the lens's blur, a Gaussian; borders go on outwards."""
    sd_px = camera.lens.blur * camera.width
    if sd_px < SHARP_PX:
        return light
    down, across = (_gaussian(side, sd_px) for side in light.shape)
    return down @ light @ across.T


def _gaussian(side: int, sd_px: float) -> np.ndarray:
    """(side, side) shares of each pixel in each blurred one.

    The discrete analogue of a Gaussian (T. Lindeberg, "Scale-space for discrete signals", PAMI 12(3), 1990): it has the
    standard deviation that is asked for, however small, where samples of a Gaussian have none below half a pixel.
    """
    reach = int(np.ceil(4.0 * sd_px)) + 3
    offsets = np.arange(-reach, reach + 1)
    # its transform is known in closed form, and its tails end well before they meet themselves
    waves = 2 * np.pi * offsets / len(offsets)
    share = np.cos(np.outer(offsets, waves)) @ np.exp(sd_px**2 * (np.cos(waves) - 1))
    spread = np.zeros((side, side))
    for offset, part in zip(offsets, share / share.sum(), strict=True):
        spread[np.arange(side), np.clip(np.arange(side) + offset, 0, side - 1)] += part
    return spread
