"""Finds the strips of a rig's mesh along which lashes grow, as grids from root to tip."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from facegen.conventions import Part
from facegen.rigs.rig import Rig


@dataclass(frozen=True, kw_only=True, eq=False)
class LashStrip:
    """Vertices (m, n) of a strip's grid, from inner to outer corner and from root to tip, and which lid it is on."""

    grid: np.ndarray
    lid: str


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
    strip_of_vertex = scipy.sparse.csgraph.connected_components(
        _edges(quads, len(rig.vertices)), directed=False
    )[1]
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


def _edges(quads: np.ndarray, count: int) -> scipy.sparse.csr_matrix:
    """Symmetric (count, count) matrix of how many quads share each edge."""
    sides = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    once = scipy.sparse.csr_matrix((np.ones(len(sides)), sides.T), shape=(count, count))
    return once + once.T


def _grid(quads: np.ndarray, vertices: np.ndarray, eye_center: np.ndarray) -> np.ndarray | None:
    """(m, n) vertex numbers of one strip, or None where it is no grid with four corners."""
    edges = _edges(quads, len(vertices))
    uses = np.bincount(quads.ravel(), minlength=len(vertices))
    border = edges.tocoo()
    rim = scipy.sparse.csr_matrix((border.data == 1, (border.row, border.col)), shape=edges.shape)
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
        reached = scipy.sparse.csgraph.dijkstra(
            edges, directed=False, unweighted=True, indices=side, min_only=True
        )
        return reached[used].astype(int)

    used = np.unique(quads)
    column, row = steps(ends[0]), steps(roots)
    grid = np.full((len(roots), len(ends[0])), -1)
    if (column.max() + 1, row.max() + 1) != grid.shape:
        return None
    grid[column, row] = used
    return grid if (grid >= 0).all() else None
