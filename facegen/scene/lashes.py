"""Lashes: strands that grow in clumps along a rig's lash strips, which carry them with every movement of the lids."""

from dataclasses import dataclass

import numpy as np
import scipy

from facegen.rigs import Rig
from facegen.rigs.lash_strips import LashStrip, lash_strips
from facegen.scene.strands import strand_tubes

POINTS = 7
"""Of a strand, from root to tip."""
STRANDS = {"upper": 105, "lower": 60}
"""Of a lid, at a density of 1; people have 90 to 160 above and 75 to 80 below [1]_, some hidden behind others."""
CLUMP = (2, 5)
"""Fewest and most strands that close towards a common tip."""
LENGTH_M = {"upper": 9.5e-3, "lower": 6.0e-3}
"""Of the longest lashes of a lid at a length of 1; people's upper ones are 8 to 12 mm long, the lower 6 to 8 [1]_."""
BARE = 0.12
"""Share of a lid, from the inner corner to the lacrimal point, that has no lashes."""
CLOSING = 0.7
"""Share of the way to its clump's middle that a tip goes."""
ROOT_RADIUS_M, TIP_RADIUS_M = 0.1e-3, 0.035e-3
SCATTER_M = 0.9e-3
"""Standard deviation by which tips leave the strip: lashes grow in two to three rows."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Lashes:
    """Where one person's lashes grow, for each strip of the rig.

    Attributes
    ----------
    strips
        The rig's, in its order.
    place
        For each, (s, `POINTS`, 2) places: along the lid, 0 to 1, and from the root, in depths of the grid. Beyond 1
        a strand goes straight on.
    aside_m
        For each, (s, `POINTS`) distances from the strip, along its normal.
    radius_m
        For each, (s, `POINTS`).
    """

    strips: tuple[LashStrip, ...]
    place: tuple[np.ndarray, ...]
    aside_m: tuple[np.ndarray, ...]
    radius_m: tuple[np.ndarray, ...]


def draw_lashes(rng: np.random.Generator, rig: Rig, *, density: float = 1.0, length: float = 1.0) -> Lashes:
    """A person's lashes.

    Parameters
    ----------
    rng
        The person's stream.
    density, length
        Relative to `STRANDS` and `LENGTH_M`.
    """
    strips = lash_strips(rig)
    drawn = [
        _draw_strip(rng, strip, strips, density, length * LENGTH_M[strip.lid] / _depth_m(strip, rig))
        for strip in strips
    ]
    return Lashes(
        strips=strips, **{key: tuple(one[key] for one in drawn) for key in ("place", "aside_m", "radius_m")}
    )


def _draw_strip(
    rng: np.random.Generator, strip: LashStrip, strips: tuple[LashStrip, ...], density: float, length: float
) -> dict[str, np.ndarray]:
    # a rig may lay several strips over each other: they share the lid's strands
    layers = max(sum(other.lid == strip.lid for other in strips) // 2, 1)
    count = max(round(STRANDS[strip.lid] * density / layers), 1)
    size = rng.integers(CLUMP[0], CLUMP[1] + 1, count)
    clump = np.repeat(np.arange(count), size)[:count]
    root = BARE + (1.0 - BARE) * (np.arange(count) + rng.uniform(0.05, 0.95, count)) / count
    middle = np.bincount(clump, root, count)[clump] / np.bincount(clump, minlength=count)[clump]
    middle = middle + rng.normal(0.0, 0.3 / count, count)[clump]
    # shorter towards the inner corner and the outer end; hairs of a clump are of one age, more or less
    longest = np.sin(np.pi * np.clip(root, 0.05, 0.93)) ** 0.5
    reach = length * longest * (0.75 + 0.25 * rng.random(count)[clump]) * rng.uniform(0.8, 1.0, count)
    t = np.linspace(0.0, 1.0, POINTS)
    u = root[:, None] + ((middle - root) * CLOSING)[:, None] * t**1.5
    u = u + (rng.normal(0.0, 0.6 / count, count)[:, None]) * t**2
    v = reach[:, None] * t
    row = rng.normal(0.0, SCATTER_M, count)[clump] * 0.7 + rng.normal(0.0, SCATTER_M, count) * 0.4
    taper = ROOT_RADIUS_M + (TIP_RADIUS_M - ROOT_RADIUS_M) * t**1.3
    thickness = rng.uniform(0.75, 1.1, count) * (1.0 if strip.lid == "upper" else 0.75)
    return dict(
        place=np.stack([np.clip(u, 0.0, 1.0), v], axis=-1),
        aside_m=row[:, None] * t * (reach / max(length, 1e-6))[:, None],
        radius_m=thickness[:, None] * taper,
    )


def _depth_m(strip: LashStrip, rig: Rig) -> float:
    """From the roots to the border of the mean head's strip."""
    steps = np.linalg.norm(np.diff(rig.vertices[strip.grid], axis=1), axis=-1)
    return float(steps.sum(axis=1).mean())


def lash_tubes(lashes: Lashes, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) and quads (Q, 4) of a person's lashes on an evaluated head (V, 3), metres."""
    centres, radii = [np.zeros((0, POINTS, 3))], [np.zeros((0, POINTS))]
    for strip, place, aside, radius in zip(
        lashes.strips, lashes.place, lashes.aside_m, lashes.radius_m, strict=True
    ):
        surface = vertices[strip.grid]
        normal = np.cross(np.gradient(surface, axis=0), np.gradient(surface, axis=1))
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        at = place * (np.array(strip.grid.shape) - 1.0)
        beyond = np.maximum(at[..., 1] - (strip.grid.shape[1] - 1.0), 0.0)
        onwards = _sampled(np.gradient(surface, axis=1), at)
        centres.append(
            _sampled(surface, at) + aside[..., None] * _sampled(normal, at) + beyond[..., None] * onwards
        )
        radii.append(radius)
    return strand_tubes(np.concatenate(centres), np.concatenate(radii))


def _sampled(grid: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Values (s, p, 3) of a grid (m, n, 3) at places (s, p, 2) in steps, between them by straight lines."""
    coordinates = np.moveaxis(at, -1, 0)
    return np.stack(
        [
            scipy.ndimage.map_coordinates(grid[..., axis], coordinates, order=1, mode="nearest")
            for axis in range(3)
        ],
        axis=-1,
    )
