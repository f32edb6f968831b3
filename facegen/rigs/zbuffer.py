"""A small orthographic z-buffer for judging rigs: which face is nearest along z, at each point of a grid.

`facegen.raster` renders scenes through real cameras; this one lies below it, knows no cameras and needs only
NumPy.
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
    z = np.full(shape[0] * shape[1], -np.inf)
    hit = np.full(shape[0] * shape[1], -1)
    corner = vertices[triangles]
    column = (corner[..., 0] - origin[0]) / step
    row = (origin[1] - corner[..., 1]) / step
    first = np.maximum(np.ceil(np.stack([row.min(1), column.min(1)], -1)).astype(int), 0)
    last = np.minimum(np.floor(np.stack([row.max(1), column.max(1)], -1)).astype(int), np.array(shape) - 1)
    size = np.maximum(last - first + 1, 0)
    for some in _batches(size.prod(axis=1)):
        triangle = np.repeat(some, size[some].prod(axis=1))
        local = _counted(size[some].prod(axis=1))
        pixel_row = first[triangle, 0] + local // size[triangle, 1]
        pixel_column = first[triangle, 1] + local % size[triangle, 1]
        u, v = _barycentric(column, row, triangle, pixel_column, pixel_row)
        inside = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0)
        triangle, u, v = triangle[inside], u[inside], v[inside]
        pixel = pixel_row[inside] * shape[1] + pixel_column[inside]
        z0, z1, z2 = corner[triangle, :, 2].T
        depth = z0 + u * (z1 - z0) + v * (z2 - z0)
        np.maximum.at(z, pixel, depth)
        front = depth == z[pixel]
        hit[pixel[front]] = triangle[front]
    return DepthMap(z=z.reshape(shape), triangle=hit.reshape(shape))


def _batches(pixels: np.ndarray, limit: int = 4_000_000) -> list[np.ndarray]:
    """Triangles with pixels at all, in groups of about ``limit`` pixels: memory stays near 300 MB."""
    drawn = np.flatnonzero(pixels)
    return (
        np.split(drawn, np.flatnonzero(np.diff(np.cumsum(pixels[drawn]) // limit)) + 1) if len(drawn) else []
    )


def _counted(lengths: np.ndarray) -> np.ndarray:
    """0 .. length - 1 for each length, one after the other."""
    ends = np.cumsum(lengths)
    return np.arange(ends[-1]) - np.repeat(ends - lengths, lengths)


def _barycentric(
    column: np.ndarray, row: np.ndarray, triangle: np.ndarray, pixel_column: np.ndarray, pixel_row: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Weights of the second and third corner at the pixels; NaN, hence outside, for triangles edge on."""
    ax, ay = column[:, 1] - column[:, 0], row[:, 1] - row[:, 0]
    bx, by = column[:, 2] - column[:, 0], row[:, 2] - row[:, 0]
    area = ax * by - ay * bx
    area = np.where(np.abs(area) > 1e-12, area, np.nan)
    px, py = pixel_column - column[triangle, 0], pixel_row - row[triangle, 0]
    u = (px * by[triangle] - py * bx[triangle]) / area[triangle]
    v = (py * ax[triangle] - px * ay[triangle]) / area[triangle]
    return u, v
