"""Draws glints: spots of light that are added to a view's finished radiance."""

import numpy as np
import scipy

from facegen.labels.glints import Glints

REACH = 5.0
"""Standard deviations to which a spot is drawn; beyond, the brightest is below a grey level."""
CLUMP = np.array([[0.0, 0.0, 0.4], [0.7, 0.3, 0.2], [-0.5, 0.6, 0.15], [0.2, -0.8, 0.15], [-0.9, -0.4, 0.1]])
"""What an uneven mirror makes of a spot: places in units of ``clump_px``, and shares of the light."""
DISC = np.array(
    [[0.0, 0.0, 1.0 / 19.0]]
    + [[0.5 * np.cos(a), 0.5 * np.sin(a), 1.0 / 19.0] for a in np.arange(6) * np.pi / 3.0]
    + [[0.87 * np.cos(a), 0.87 * np.sin(a), 1.0 / 19.0] for a in (np.arange(12) + 0.5) * np.pi / 6.0]
)
"""The same of an LED that a lens mirrors: large enough to show as a disc, whose radius ``clump_px`` then is."""
_RAYS = np.array([[a, d] for a in (0.3, 1.5, 2.2, 3.5, 4.55, 5.4) for d in np.linspace(1.6, 11.0, 20)])
STAR_SHARE = 0.06
STAR = np.concatenate(
    [
        DISC * [1.0, 1.0, 1.0 - STAR_SHARE],
        np.stack(
            [
                _RAYS[:, 1] * np.cos(_RAYS[:, 0]),
                _RAYS[:, 1] * np.sin(_RAYS[:, 0]),
                STAR_SHARE * _RAYS[:, 1] ** -1.5 / (_RAYS[:, 1] ** -1.5).sum(),
            ],
            axis=-1,
        ),
    ]
)
"""The disc with rays: scratches and smears of worn lenses spread a small share of the light across them."""
CLUMP_BLUR = 0.5
"""Further standard deviation of each spot of a clump in units of ``clump_px``: they run into each other."""


DISC_BLUR = 0.22
"""Likewise of a disc: its spots make an even face."""
_PATTERNS = {"cornea": np.array([[0.0, 0.0, 1.0]]), "sclera": CLUMP, "tears": CLUMP, "lens": STAR}


def with_glints(radiance: np.ndarray, glints: Glints) -> np.ndarray:
    """A view's radiance with its seen glints: Gaussian spots, integrated over each pixel.

    Parameters
    ----------
    radiance
        (h, w) float32, W sr-1 m-2.
    glints
        The view's.

    Returns
    -------
    numpy.ndarray
        (h, w) float32 whose values 16-bit floats hold exactly, as a view's file does.
    """
    total = radiance.astype(np.float64)
    for i in np.flatnonzero(glints.seen):
        spots = _PATTERNS[glints.surfaces[i]]
        blur = DISC_BLUR if glints.surfaces[i] == "lens" else CLUMP_BLUR
        for *aside, share in spots:
            middle = glints.points_2d[i] + glints.clump_px[i] * np.array(aside)
            sigma = np.hypot(glints.sigma_px[i], blur * glints.clump_px[i])
            _add_spot(total, middle, sigma, share * glints.volume[i])
    return np.minimum(total, np.finfo(np.float16).max).astype(np.float16).astype(np.float32)


def _add_spot(image: np.ndarray, middle_px: np.ndarray, sigma_px: float, volume: float) -> None:
    profile, window = [], []
    for middle, size in zip(middle_px, image.shape[::-1], strict=True):
        reach = REACH * sigma_px + 1.0
        first, last = max(round(middle - reach), 0), min(round(middle + reach), size - 1)
        if first > last:  # rays of a star leave the picture
            return
        edges = np.arange(first, last + 2) - 0.5
        profile.append(np.diff(0.5 * scipy.special.erf((edges - middle) / (sigma_px * np.sqrt(2.0)))))
        window.append(slice(first, last + 1))
    image[window[1], window[0]] += volume * profile[1][:, None] * profile[0]
