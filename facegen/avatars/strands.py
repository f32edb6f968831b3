"""The picture that hair is painted with: strands with gaps between them."""

import numpy as np
from scipy import ndimage

from facegen.avatars.haircuts import HairStyle

LAYERS = 4
"""Shells of hair one above the other; the picture has a band for each."""
WIDE_PX, BAND_PX = 512, 128


def draw_strands(style: HairStyle, rng: np.random.Generator) -> np.ndarray:
    """Picture (`WIDE_PX`, `WIDE_PX`, 4): one band a layer, strands running down, with gaps in the outer ones.

    Rows of a band are equal but for the strands' ends, which makes a small PNG.
    """
    rows = BAND_PX
    place = np.arange(rows)[:, None] / rows
    bands = []
    for layer in range(LAYERS):
        fine = ndimage.gaussian_filter1d(rng.standard_normal(WIDE_PX), 0.8, mode="reflect")
        broad = ndimage.gaussian_filter1d(rng.standard_normal(WIDE_PX), 6.0, mode="reflect")
        light = 0.72 + 0.16 * fine / fine.std() * 0.8 + 0.07 * broad / broad.std()
        density = ndimage.gaussian_filter1d(rng.standard_normal(WIDE_PX), 1.1, mode="reflect")
        order = density.argsort().argsort() / WIDE_PX  # 0 to 1, evenly
        length = ndimage.gaussian_filter1d(rng.standard_normal(WIDE_PX), 1.3, mode="reflect")
        length = 1.0 - style.ragged * (0.3 + 0.7 * layer / (LAYERS - 1)) * np.abs(length / length.std())
        length = np.minimum(length, 0.985)
        gaps = 0.0 if layer == 0 else 0.22 + 0.5 * layer / LAYERS * (0.4 + 0.6 * place)
        cover = (order >= gaps) & (place < length) & (place > 0.04 * layer)
        band = np.empty((rows, WIDE_PX, 4), np.uint8)
        band[..., :3] = np.rint(255.0 * np.clip(light, 0.25, 1.0))[None, :, None]
        band[..., 3] = 255 * cover
        bands.append(band)
    return np.concatenate(bands)
