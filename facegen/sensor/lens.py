"""Computes lens shading: the share of the light that gets through, across the picture."""

import numpy as np

from facegen.headsets import HeadsetCamera


def transmission(camera: HeadsetCamera) -> np.ndarray:
    """(h, w) shares, 0 to 1, of the light that vignette and aperture leave."""
    v, u = np.mgrid[0 : camera.height, 0 : camera.width].astype(np.float64)
    squared = (u - camera.cx) ** 2 + (v - camera.cy) ** 2
    left = 1.0 - camera.lens.vignette * squared / squared.max()
    # the rim's edge falls within a pixel
    return left * np.clip(camera.inside_aperture_px(np.stack([u, v], axis=-1)) + 0.5, 0.0, 1.0)
