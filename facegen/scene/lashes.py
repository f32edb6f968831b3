"""Texture coordinates of lash strips, for strands to be drawn on: along the lid, and from root to tip."""

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph


def lash_uv(vertices: np.ndarray, faces: np.ndarray, uv: np.ndarray, eye_center: np.ndarray) -> np.ndarray:
    """Coordinates of each strip's own grid: u along the lid, from 0 to 1, and v from root (0) to tip (1).

    Rigs bend their strips' patches of the atlas, so rows and columns are counted on the mesh. Hair grows away
    from the eye, which tells roots from tips. A strip that is no plain grid keeps its texture coordinates.

    Parameters
    ----------
    vertices
        (V, 3) neutral head.
    faces
        (F, 4) quads of the lash strips.
    uv
        (F, 4, 2) their texture coordinates.
    eye_center
        (2, 3).

    Returns
    -------
    numpy.ndarray
        (F, 4, 2) coordinates in [0, 1].
    """
    corners = np.where(faces < 0, faces[:, :1], faces)
    strip_of_face = csgraph.connected_components(_edges(corners, len(vertices)), directed=False)[1][
        corners[:, 0]
    ]
    stretched = uv.copy()
    for strip in np.unique(strip_of_face):
        rows = strip_of_face == strip
        grid = _grid_coordinates(corners[rows], vertices, eye_center)
        if grid is not None:
            stretched[rows] = grid[corners[rows]]
    return stretched


def _edges(quads: np.ndarray, count: int) -> sparse.csr_matrix:
    """Symmetric (count, count) matrix of how many quads share each edge."""
    sides = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    once = sparse.csr_matrix((np.ones(len(sides)), sides.T), shape=(count, count))
    return once + once.T


def _grid_coordinates(quads: np.ndarray, vertices: np.ndarray, eye_center: np.ndarray) -> np.ndarray | None:
    """(V, 2) rows of u and v of one strip's vertices, or None where it has not four corners."""
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
    roots, tips = lengths if away[0] < away[1] else lengths[::-1]

    def steps(side: list[int]) -> np.ndarray:
        reached = csgraph.dijkstra(edges, directed=False, unweighted=True, indices=side, min_only=True)
        return np.where(np.isfinite(reached), reached, 0.0)

    u, v = (steps(start) / steps(start)[goal[len(goal) // 2]] for start, goal in (ends, (roots, tips)))
    return np.stack([u, v], axis=-1)
