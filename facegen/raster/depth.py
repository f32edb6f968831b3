"""Depth and part pictures of a mesh by z-buffer, for checks and previews."""

import numpy as np

from facegen.raster.occlusion import depth_on_triangles


def depth_image(
    vertices_plane: np.ndarray, inverse_z: np.ndarray, triangles: np.ndarray, *, width: int, height: int
) -> tuple[np.ndarray, np.ndarray]:
    """Nearest depth at every pixel's centre, and which triangle it belongs to.

    Parameters
    ----------
    vertices_plane
        (V, 2) vertices in pixels of an undistorted (pinhole) picture; NaN for vertices behind the camera.
    inverse_z
        (V,) 1/z in 1/metres.
    triangles
        (T, 3) vertex indices.

    Returns
    -------
    depth_m : numpy.ndarray
        (height, width) metres along z, +inf where there is nothing.
    triangle : numpy.ndarray
        (height, width) int64, -1 where there is nothing.
    """
    corners = vertices_plane[triangles]
    low = np.ceil(np.maximum(corners.min(axis=1), 0.0))
    high = np.floor(np.minimum(corners.max(axis=1), (width - 1.0, height - 1.0)))
    span = np.nan_to_num(high - low + 1, nan=0.0).clip(0).astype(np.int64)
    pixels = span[:, 0] * span[:, 1]
    face = np.repeat(np.arange(len(triangles)), pixels)
    within = np.arange(pixels.sum()) - np.repeat(np.cumsum(pixels) - pixels, pixels)
    x = (low[face, 0] + within % span[face, 0]).astype(np.int64)
    y = (low[face, 1] + within // span[face, 0]).astype(np.int64)
    z = depth_on_triangles(np.stack([x, y], axis=-1).astype(np.float64), corners[face], inverse_z[triangles[face]])
    order = np.argsort(-z, kind="stable")  # the nearest is written last and stays
    depth = np.full((height, width), np.inf)
    owner = np.full((height, width), -1, np.int64)
    x, y, z, face = x[order], y[order], z[order], face[order]
    seen = np.isfinite(z)
    depth[y[seen], x[seen]] = z[seen]
    owner[y[seen], x[seen]] = face[seen]
    return depth, owner
