"""A small orthographic z-buffer for judging rigs: which face is nearest along z, at each point of a grid.

`facegen.raster` renders scenes through real cameras; this one lies below it, knows no cameras and needs only NumPy.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True, eq=False)
class DepthMap:
    """``z`` (h, w) of the nearest surface, -inf where there is none; ``triangle`` (h, w) its index, else -1.

    Pixel (row, column) samples the point ``origin + (column, -row) * step`` of the xy plane.
    """

    z: np.ndarray
    triangle: np.ndarray


def triangles_of(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (t, 3) of quads padded with -1 (f, 4), and the face each came from."""
    quad = faces[:, 3] >= 0
    triangles = np.concatenate([faces[:, :3], faces[quad][:, [0, 2, 3]]])
    return triangles, np.concatenate([np.arange(len(faces)), np.flatnonzero(quad)])


def nearest_along_z(
    vertices: np.ndarray, triangles: np.ndarray, *, origin: np.ndarray, step: float, shape: tuple[int, int]
) -> DepthMap:
    """Draw ``triangles`` (t, 3) over ``vertices`` (v, 3), seen from +z, both sides of each.

    Parameters
    ----------
    origin
        (2,) x and y of the top-left sample.
    step
        Distance of samples.
    shape
        Height and width in samples.
    """
    z = np.full(shape, -np.inf)
    hit = np.full(shape, -1)
    corner = vertices[triangles]
    column = (corner[..., 0] - origin[0]) / step
    row = (origin[1] - corner[..., 1]) / step
    first_column, last_column = np.ceil(column.min(1)).astype(int), np.floor(column.max(1)).astype(int)
    first_row, last_row = np.ceil(row.min(1)).astype(int), np.floor(row.max(1)).astype(int)
    first_column, first_row = np.maximum(first_column, 0), np.maximum(first_row, 0)
    last_column, last_row = np.minimum(last_column, shape[1] - 1), np.minimum(last_row, shape[0] - 1)
    ax, ay = column[:, 1] - column[:, 0], row[:, 1] - row[:, 0]
    bx, by = column[:, 2] - column[:, 0], row[:, 2] - row[:, 0]
    area = ax * by - ay * bx
    drawn = (first_column <= last_column) & (first_row <= last_row) & (np.abs(area) > 1e-12)
    for t in np.flatnonzero(drawn):
        rows = slice(first_row[t], last_row[t] + 1)
        columns = slice(first_column[t], last_column[t] + 1)
        px = np.arange(columns.start, columns.stop) - column[t, 0]
        py = np.arange(rows.start, rows.stop)[:, None] - row[t, 0]
        u = (px * by[t] - py * bx[t]) / area[t]
        v = (py * ax[t] - px * ay[t]) / area[t]
        depth = (
            corner[t, 0, 2]
            + u * (corner[t, 1, 2] - corner[t, 0, 2])
            + v * (corner[t, 2, 2] - corner[t, 0, 2])
        )
        nearer = (u >= 0) & (v >= 0) & (u + v <= 1) & (depth > z[rows, columns])
        z[rows, columns] = np.where(nearer, depth, z[rows, columns])
        hit[rows, columns] = np.where(nearer, t, hit[rows, columns])
    return DepthMap(z=z, triangle=hit)
