"""Lashes: strands that grow in clumps along a rig's lash strips, which carry them with every movement of the lids."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy import ndimage, sparse
from scipy.sparse import csgraph

from facegen.conventions import Part
from facegen.rigs import Rig
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
class LashStrip:
    """Vertices (m, n) of a strip's grid, from inner to outer corner and from root to tip, and which lid it is on."""

    grid: np.ndarray
    lid: str


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
        [ndimage.map_coordinates(grid[..., axis], coordinates, order=1, mode="nearest") for axis in range(3)],
        axis=-1,
    )


@lru_cache(maxsize=8)
def lash_strips(rig: Rig) -> tuple[LashStrip, ...]:
    """The rig's lash strips that are plain grids; rigs without any have no lashes.

    Rows and columns are counted on the mesh, because rigs bend their patches of the texture. Hair grows away from
    the eye, which tells roots from tips.
    """
    faces = rig.faces[rig.part == Part.LASHES]
    quads = faces[(faces >= 0).all(axis=1)]
    if not len(quads):
        return ()
    strip_of_vertex = csgraph.connected_components(_edges(quads, len(rig.vertices)), directed=False)[1]
    grids = []
    for strip in np.unique(strip_of_vertex[quads[:, 0]]):
        grid = _grid(quads[strip_of_vertex[quads[:, 0]] == strip], rig.vertices, rig.eye_center)
        if grid is not None:
            grids.append(grid)
    height = [rig.vertices[grid[:, 0], 1].mean() for grid in grids]
    return tuple(
        LashStrip(grid=_outwards(grid, rig.vertices), lid="upper" if y >= np.mean(height) else "lower")
        for grid, y in zip(grids, height, strict=True)
    )


def _outwards(grid: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """The same grid, starting at the inner corner."""
    first, last = np.abs(vertices[grid[[0, -1], 0], 0])
    return grid if first < last else grid[::-1]


def _edges(quads: np.ndarray, count: int) -> sparse.csr_matrix:
    """Symmetric (count, count) matrix of how many quads share each edge."""
    sides = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    once = sparse.csr_matrix((np.ones(len(sides)), sides.T), shape=(count, count))
    return once + once.T


def _grid(quads: np.ndarray, vertices: np.ndarray, eye_center: np.ndarray) -> np.ndarray | None:
    """(m, n) vertex numbers of one strip, or None where it is no grid with four corners."""
    edges = _edges(quads, len(vertices))
    uses = np.bincount(quads.ravel(), minlength=len(vertices))
    border = edges.tocoo()
    rim = sparse.csr_matrix((border.data == 1, (border.row, border.col)), shape=edges.shape)
    loop = [int(np.flatnonzero(uses == 1)[0])]
    while True:
        ahead = [int(n) for n in rim[loop[-1]].nonzero()[1] if n not in loop[-2:]]
        if not ahead or ahead[0] == loop[0]:
            break
        loop.append(ahead[0])
    turns = [index for index, vertex in enumerate(loop) if uses[vertex] == 1]
    if len(turns) != 4:
        return None
    closed = [*loop, loop[0]]
    sides = [closed[a : b + 1] for a, b in zip(turns, [*turns[1:], len(loop)], strict=True)]
    ends, lengths = (sides[1::2], sides[::2]) if len(sides[0]) > len(sides[1]) else (sides[::2], sides[1::2])
    away = [
        np.linalg.norm(vertices[side][:, None] - eye_center, axis=-1).min(axis=1).mean() for side in lengths
    ]
    roots = lengths[int(away[0] > away[1])]

    def steps(side: list[int]) -> np.ndarray:
        reached = csgraph.dijkstra(edges, directed=False, unweighted=True, indices=side, min_only=True)
        return reached[used].astype(int)

    used = np.unique(quads)
    column, row = steps(ends[0]), steps(roots)
    grid = np.full((len(roots), len(ends[0])), -1)
    if (column.max() + 1, row.max() + 1) != grid.shape:
        return None
    grid[column, row] = used
    return grid if (grid >= 0).all() else None
