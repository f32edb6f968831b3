"""Crowns of the permanent teeth as closed meshes, from tables of their mean sizes.

A crown's frame: x along the arch, away from the midline (distal), d outwards (towards lips and cheeks), h from the tip
of the crown towards its root; the origin lies on the line of contacts at the height of the tip.

References
----------
.. [1] S. Nelson and M. Ash, "Wheeler's Dental Anatomy, Physiology, and Occlusion", 9th ed. 2010, table 1-1: lengths and
   diameters of crowns.
.. [2] L. Andrews, "The six keys to normal occlusion", Am. J. Orthodontics 62(3), 1972: inclination of crowns. Ours are
   smaller from the canines on, as the crowns' own curvature is part of the measured ones.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from facegen.geometry.grids import ring_quads

AROUND = 20
LEVELS = np.array([-0.35, 0.0, 0.1, 0.25, 0.42, 0.6, 0.75, 0.86, 0.94, 0.98, 1.0])
"""Heights of a crown's rings, 0 at the neck, 1 at the tip; those below 0 stand in the gum."""
CAP = np.array([0.85, 0.58, 0.28])
"""Sizes of the rings that close it."""


@dataclass(frozen=True, kw_only=True)
class Tooth:
    """A crown's sizes [1]_ in millimetres, its inclination [2]_ in degrees.

    ``length`` from neck to tip; ``width`` along the arch and ``depth`` across it, with those at the neck; ``face`` how
    far the outer surface stands before the line of contacts; ``inclination`` of the crown outwards; ``below`` how much
    the tip is short of the plane of the teeth.
    """

    kind: str
    length: float
    width: float
    neck_width: float
    depth: float
    neck_depth: float
    face: float
    inclination: float
    below: float


def _teeth(rows: tuple) -> tuple[Tooth, ...]:
    return tuple(
        Tooth(
            kind=k,
            length=c,
            width=w,
            neck_width=nw,
            depth=d,
            neck_depth=nd,
            face=f,
            inclination=i,
            below=b,
        )
        for k, c, w, nw, d, nd, f, i, b in rows
    )


UPPER = _teeth(
    (
        ("incisor", 10.5, 8.5, 7.0, 7.0, 6.0, 2.3, 7.0, 0.0),
        ("incisor", 9.0, 6.5, 5.0, 6.0, 5.0, 2.1, 4.0, 0.7),
        ("canine", 10.0, 7.5, 5.5, 8.0, 7.0, 2.9, -3.0, 0.1),
        ("premolar", 8.5, 7.0, 5.0, 9.0, 8.0, 3.6, -4.0, 0.5),
        ("premolar", 8.5, 7.0, 5.0, 9.0, 8.0, 3.7, -4.0, 0.8),
        ("molar", 7.5, 10.0, 8.0, 11.0, 10.0, 4.4, -5.0, 1.0),
        ("molar", 7.0, 9.0, 7.0, 11.0, 10.0, 4.3, -5.0, 0.8),
    )
)
"""From the midline to the second molar."""
LOWER = _teeth(
    (
        ("incisor", 9.0, 5.0, 3.5, 6.0, 5.3, 1.9, 1.0, 0.0),
        ("incisor", 9.5, 5.5, 4.0, 6.5, 5.8, 1.9, 0.0, 0.1),
        ("canine", 11.0, 7.0, 5.5, 7.5, 7.0, 2.7, -5.0, 0.0),
        ("premolar", 8.5, 7.0, 5.0, 7.5, 6.5, 3.4, -9.0, 1.0),
        ("premolar", 8.0, 7.0, 5.0, 8.0, 7.0, 3.6, -11.0, 1.6),
        ("molar", 7.5, 11.0, 9.0, 10.5, 9.0, 4.4, -14.0, 2.0),
        ("molar", 7.0, 10.5, 8.0, 10.0, 9.0, 4.3, -14.0, 1.9),
    )
)


@lru_cache(maxsize=32)
def crown(tooth: Tooth) -> tuple[np.ndarray, np.ndarray]:
    """A crown's vertices (n, 3), columns x, d, h in metres, and quads (f, 4) int32, outsides out for ``(x, d, h)``
    right-handed; triangles at the tip are padded with -1."""
    turn = np.arange(AROUND) * (2.0 * np.pi / AROUND)
    power = 2.0 / {"incisor": 4.0, "canine": 2.2, "premolar": 2.6, "molar": 3.2}[tooth.kind]
    x, d = (np.sign(f) * np.abs(f) ** power for f in (np.cos(turn), np.sin(turn)))
    rings = [_ring(tooth, level, 1.0, x, d) for level in LEVELS]
    rings += [_ring(tooth, 1.0, size, x, d) for size in CAP]
    tip = _ring(tooth, 1.0, 0.0, np.zeros(1), np.zeros(1))
    vertices = np.concatenate([*rings, tip])
    quads = ring_quads(len(rings), AROUND)
    last, j = (len(rings) - 1) * AROUND, np.arange(AROUND)
    fan = np.stack(
        [last + j, np.full(AROUND, len(vertices) - 1), last + (j + 1) % AROUND, np.full(AROUND, -1)], axis=-1
    )
    return 1e-3 * vertices, np.concatenate([quads, fan]).astype(np.int32)


def neck(tooth: Tooth) -> tuple[float, float]:
    """How far the outer and the inner surface stand outwards from the line of contacts at the neck, in metres."""
    outer = _outlines(tooth)[1]
    inner = _outlines(tooth)[2]
    return 1e-3 * float(outer(0.0)), 1e-3 * float(inner(0.0))


@lru_cache(maxsize=32)
def _outlines(tooth: Tooth) -> tuple[Callable[[np.ndarray], np.ndarray], ...]:
    """Half width, outer and inner surface by height, millimetres."""
    w, nw, face, depth = tooth.width / 2, tooth.neck_width / 2, tooth.face, tooth.depth
    if tooth.kind in ("incisor", "canine"):
        tip = 1.0 if tooth.kind == "incisor" else 1.5
        heights = [-0.35, 0.0, 0.25, 0.5, 0.8, 0.93, 1.0]
        half = [0.9 * nw, nw, nw + 0.5 * (w - nw), nw + 0.88 * (w - nw), w, w, 0.975 * w]
        outer = [face - 1.1, face - 0.55, face, face - 0.05, face - 0.3 * tip, face - 0.6 * tip, face - tip]
        back = face - 0.55 - tooth.neck_depth
        hollow = 0.57 if tooth.kind == "incisor" else 0.75
        inner = [back + 0.4, back, face - 0.95 * depth, face - hollow * depth, face - 0.34 * depth]
        inner += [face - tip - 1.3, face - tip - 0.8]
        inner[3] = max(inner[3], inner[2])
    else:
        heights = [-0.35, 0.0, 0.3, 0.6, 0.8, 0.93, 1.0]
        half = [0.93 * nw, nw, nw + 0.6 * (w - nw), w, 0.985 * w, 0.94 * w, 0.86 * w]
        outer = [face - 1.0, face - 0.5, face, face - 0.2, face - 0.6, face - 1.1, face - 1.7]
        back = face - 0.5 - tooth.neck_depth
        inner = [back + 0.3, back, face - depth + 0.1, face - depth + 0.15]
        inner += [face - depth + 0.6, face - depth + 1.1, face - depth + 1.7]
    return tuple(scipy.interpolate.PchipInterpolator(heights, values) for values in (half, outer, inner))


def _ring(tooth: Tooth, level: float, size: float, x: np.ndarray, d: np.ndarray) -> np.ndarray:
    half, outer, inner = (float(outline(level)) for outline in _outlines(tooth))
    x, d = size * x, size * d
    middle, reach = (outer + inner) / 2, (outer - inner) / 2
    # towards the tongue crowns of front teeth narrow
    narrow = 1.0 - (0.28 if tooth.kind in ("incisor", "canine") else 0.08) * np.clip(-d, 0.0, 1.0)
    rise = np.clip((level - 0.4) / 0.6, 0.0, 1.0)
    h = tooth.length * (1.0 - level) + tooth.length * rise**2 * (3.0 - 2.0 * rise) * _shortfall(
        tooth.kind, x, d
    )
    return np.stack([half * x * narrow, middle + reach * d, h], axis=-1)


def _shortfall(kind: str, x: np.ndarray, d: np.ndarray) -> np.ndarray:
    """How much lower than the tip the top of a crown is at (x, d) of its outline, relative to its length."""
    if kind == "incisor":
        return 0.015 * x**4 + 0.07 * np.clip(x, 0.0, None) ** 4
    if kind == "canine":
        return 0.24 * np.abs(x) ** 1.4 + 0.04 * np.clip(x, 0.0, None)
    cusps = {
        "premolar": ((0.0, 0.55, 1.0), (0.0, -0.55, 0.9)),
        "molar": ((-0.48, 0.6, 1.0), (0.48, 0.6, 0.97), (-0.48, -0.55, 1.0), (0.48, -0.55, 0.93)),
    }[kind]
    along = 2.2 if kind == "premolar" else 5.0
    hills = [top * np.exp(-along * (x - cx) ** 2 - 5.0 * (d - cd) ** 2) for cx, cd, top in cusps]
    return 0.26 * (1.0 - np.max(hills, axis=0))
