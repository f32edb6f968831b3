"""Haircuts: where the hairline runs, and how thick and long hair is."""

from dataclasses import dataclass

import numpy as np

from facegen.avatars.skull import SKULL_M


@dataclass(frozen=True, kw_only=True)
class HairStyle:
    """A haircut.

    Attributes
    ----------
    line_deg
        (azimuth, elevation) pairs of the hairline from the front (0) over the ears (90) to the nape (180).
    top_m, side_m, nape_m, edge_m
        How thick the hair lies there, and at the front of the hairline.
    ragged
        Share of its length by which strands end before the others.
    fall_m
        How far hair beside and behind the face hangs below the ears.
    sweep_rad
        How far strands of the front bend to the subject's left.
    bun_m
        Radius of a bun behind the crown; 0 for none.
    cloth
        Colour (sRGB, 0 to 1) of a cap in place of hair.
    """

    line_deg: tuple[tuple[float, float], ...]
    top_m: float
    side_m: float
    nape_m: float
    edge_m: float
    ragged: float = 0.09
    fall_m: float = 0.0
    sweep_rad: float = 0.5
    bun_m: float = 0.0
    cloth: tuple[float, float, float] | None = None


SHORT_LINE = (
    *((0.0, 30.0), (20.0, 31.5), (38.0, 34.5), (52.0, 31.0), (63.0, 22.0), (73.0, 7.0), (79.0, -5.0)),
    *((87.0, -5.0), (92.0, 6.0), (102.0, 4.0), (112.0, -8.0), (121.0, -22.0), (135.0, -33.0), (180.0, -41.0)),
)
LONG_LINE = (
    *((0.0, 35.0), (20.0, 34.0), (34.0, 29.0), (46.0, 19.0), (56.0, 9.0), (66.0, 3.0), (76.0, 0.0)),
    *((90.0, 0.0), (180.0, 0.0)),
)
CAP_LINE = (
    *((0.0, 27.0), (25.0, 27.0), (45.0, 25.0), (62.0, 18.0), (78.0, 8.0), (90.0, 7.0), (104.0, 4.0)),
    *((118.0, -14.0), (140.0, -27.0), (180.0, -32.0)),
)
STYLES: dict[str, HairStyle] = {
    "short": HairStyle(line_deg=SHORT_LINE, top_m=19e-3, side_m=7e-3, nape_m=5e-3, edge_m=3e-3),
    "cropped": HairStyle(
        line_deg=SHORT_LINE, top_m=5e-3, side_m=2.5e-3, nape_m=2e-3, edge_m=2e-3, ragged=0.05
    ),
    "long": HairStyle(
        line_deg=LONG_LINE,
        top_m=16e-3,
        side_m=19e-3,
        nape_m=15e-3,
        edge_m=6e-3,
        ragged=0.06,
        fall_m=0.15,
        sweep_rad=0.2,
    ),
    "bob": HairStyle(
        line_deg=LONG_LINE,
        top_m=17e-3,
        side_m=20e-3,
        nape_m=15e-3,
        edge_m=7e-3,
        ragged=0.04,
        fall_m=0.08,
        sweep_rad=0.3,
    ),
    "bun": HairStyle(
        line_deg=SHORT_LINE, top_m=9e-3, side_m=6e-3, nape_m=6e-3, edge_m=4e-3, ragged=0.03, bun_m=30e-3
    ),
    "cap": HairStyle(
        line_deg=CAP_LINE,
        top_m=17e-3,
        side_m=7e-3,
        nape_m=8e-3,
        edge_m=3e-3,
        ragged=0.0,
        cloth=(0.2, 0.46, 0.5),
    ),
}
"""Haircuts by name; a cap is one, for operating rooms."""


def hairline(style: HairStyle, azimuth: np.ndarray) -> np.ndarray:
    """Elevation (...) of the hairline at azimuths (...), both seen from the skull's middle, radians."""
    where, height = np.radians(np.array(style.line_deg)).T
    return np.interp(np.abs(azimuth), where, height)


def in_hair(style: HairStyle, points: np.ndarray) -> np.ndarray:
    """How far points (n, 3) of the skin lie above the hairline, radians; negative below it."""
    away = points - SKULL_M
    azimuth = np.arctan2(away[:, 0], away[:, 2])
    return np.arctan2(away[:, 1], np.hypot(away[:, 0], away[:, 2])) - hairline(style, azimuth)
