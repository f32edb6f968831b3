"""A z-buffer: which triangle is nearest at each pixel's centre, and how near."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

BATCH_PIXELS = 4_000_000
"""Pixels of triangles that are computed at once: memory stays near 300 MB."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Nearest:
    """``value`` (h, w), the largest at a pixel, -inf where there is none; ``triangle`` (h, w) that has it, else -1."""

    value: np.ndarray
    triangle: np.ndarray


def nearest_triangles(
    vertices_px: np.ndarray, value: np.ndarray, triangles: np.ndarray, *, shape: tuple[int, int]
) -> Nearest:
    """Draw both sides of triangles; at each pixel the largest value wins.

    Parameters
    ----------
    vertices_px
        (V, 2) column and row of the vertices, pixel centres at whole numbers; NaN leaves a triangle out.
    value
        (V,) what is compared, finite where ``vertices_px`` are. It must be linear over the picture: 1/z for a
        pinhole, z towards the viewer for a parallel projection.
    triangles
        (T, 3) vertex indices.
    shape
        Height and width of the picture.
    """
    best, hit = np.full(shape, -np.inf), np.full(shape, -1, np.int64)
    corners, values = vertices_px[triangles], value[triangles]
    limit = np.array([shape[1] - 1, shape[0] - 1], np.float64)
    first = np.maximum(np.ceil(corners.min(axis=1)), 0.0)
    size = np.nan_to_num(np.minimum(np.floor(corners.max(axis=1)), limit) - first + 1.0, nan=0.0)
    size = np.maximum(size, 0.0).astype(np.int64)
    first = np.nan_to_num(first).astype(np.int64)
    across, down = (np.ascontiguousarray(corners[..., axis].T) for axis in range(2))
    _filler()(first, size, across, down, _area(across, down), values, best, hit)
    return Nearest(value=best, triangle=hit)


def _filler() -> Callable[..., None]:
    """What fills triangles: the compiled loop, or the same in NumPy where Numba is not installed."""
    try:
        from facegen.raster.filling import fill
    except ModuleNotFoundError as error:
        if error.name != "numba":
            raise
        return fill_in_numpy
    return fill


def fill_in_numpy(
    first: np.ndarray,
    size: np.ndarray,
    across: np.ndarray,
    down: np.ndarray,
    area: np.ndarray,
    values: np.ndarray,
    best: np.ndarray,
    hit: np.ndarray,
) -> None:
    """`facegen.raster.filling.fill` in whole-array steps: the same bytes, at several times the cost."""
    width = best.shape[1]
    best, hit = best.reshape(-1), hit.reshape(-1)
    for some in _batches(size.prod(axis=1)):
        triangle = np.repeat(some, size[some].prod(axis=1))
        local = _counted(size[some].prod(axis=1))
        column = first[triangle, 0] + local % size[triangle, 0]
        row = first[triangle, 1] + local // size[triangle, 0]
        wa, wb, wc = _weights(column, row, across[:, triangle], down[:, triangle], area[triangle])
        inside = (wa >= 0.0) & (wb >= 0.0) & (wc >= 0.0)
        triangle, pixel = triangle[inside], row[inside] * width + column[inside]
        base, wb, wc = values[triangle, 0], wb[inside], wc[inside]
        # exact on level faces
        here = base + wb * (values[triangle, 1] - base) + wc * (values[triangle, 2] - base)
        np.maximum.at(best, pixel, here)
        front = here == best[pixel]
        hit[pixel[front]] = triangle[front]


def nearest_along_z(
    vertices: np.ndarray, triangles: np.ndarray, *, origin: np.ndarray, step: float, shape: tuple[int, int]
) -> Nearest:
    """Parallel view of vertices (V, 3) from +z, x to the right and y up; the values are z.

    Parameters
    ----------
    origin
        (2,) x and y of the top-left sample.
    step
        Distance of samples.
    shape
        Height and width in samples.
    """
    pixels = (vertices[:, :2] - origin) * np.array([1.0, -1.0]) / step
    return nearest_triangles(pixels, vertices[:, 2], triangles, shape=shape)


def barycentric(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Weights (m, 3) of the corners (m, 3, 2) at points (m, 2); NaN for triangles seen edge on."""
    across, down = corners[..., 0].T, corners[..., 1].T
    return np.stack(_weights(*points.T, across, down, _area(across, down)), axis=-1)


def _area(across: np.ndarray, down: np.ndarray) -> np.ndarray:
    """Twice the area (m,) of triangles with corners (3, m), signed; NaN of those seen edge on."""
    (ax, bx, cx), (ay, by, cy) = across, down
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return np.where(area == 0.0, np.nan, area)


def _weights(
    x: np.ndarray, y: np.ndarray, across: np.ndarray, down: np.ndarray, area: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Weights (m,) of each corner (3, m) at points (m,); coordinates apart, as rows of two are three times as slow."""
    (ax, bx, cx), (ay, by, cy) = across - x, down - y
    wa, wb = (bx * cy - by * cx) / area, (cx * ay - cy * ax) / area
    return wa, wb, 1.0 - wa - wb


def _batches(pixels: np.ndarray) -> list[np.ndarray]:
    """Triangles with pixels at all, in groups of about `BATCH_PIXELS`."""
    drawn = np.flatnonzero(pixels)
    if not len(drawn):
        return []
    return np.split(drawn, np.flatnonzero(np.diff(np.cumsum(pixels[drawn]) // BATCH_PIXELS)) + 1)


def _counted(lengths: np.ndarray) -> np.ndarray:
    """0 .. length - 1 for each length, one after the other."""
    ends = np.cumsum(lengths)
    return np.arange(ends[-1]) - np.repeat(ends - lengths, lengths)
