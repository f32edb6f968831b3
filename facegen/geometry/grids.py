"""Numbers the vertices of surfaces that are grids: quads between rows, and their triangles.

Vertices stand row by row. A quad begins at its corner of the lower row and column, and goes on to the next row.
"""

import numpy as np


def grid_quads(rows: int, columns: int) -> np.ndarray:
    """Quads ((rows - 1) * (columns - 1), 4) of an open grid."""
    row, column = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    return _between(row * columns, column, column + 1, columns)


def ring_quads(rows: int, columns: int) -> np.ndarray:
    """Quads ((rows - 1) * columns, 4) of a grid whose rows close into rings."""
    row, column = np.meshgrid(np.arange(rows - 1), np.arange(columns), indexing="ij")
    return _between(row * columns, column, (column + 1) % columns, columns)


def facing_back(quads: np.ndarray) -> np.ndarray:
    """The same quads (n, 4) seen from their other side, with the same first corners."""
    return np.ascontiguousarray(quads[:, [0, 3, 2, 1]])


def halves(quads: np.ndarray) -> np.ndarray:
    """Triangles (2n, 3) of quads (n, 4): all first halves, then all second ones, cut from the first corner on."""
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def _between(start: np.ndarray, column: np.ndarray, beside: np.ndarray, columns: int) -> np.ndarray:
    below = start + columns
    return np.stack([start + column, below + column, below + beside, start + beside], axis=-1).reshape(-1, 4)
