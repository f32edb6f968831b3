"""Which points a mesh hides from a camera."""

import numpy as np

from facegen.raster.z_buffer import barycentric


def triangles_of(faces: np.ndarray) -> np.ndarray:
    """Triangles (T, 3) of faces (F, 4) whose missing fourth corner is -1; quads are cut along their first diagonal."""
    quads = faces[faces[:, 3] >= 0]
    return np.concatenate([faces[:, :3], quads[:, [0, 2, 3]]]).astype(np.int64)


def faces_of_triangles(faces: np.ndarray) -> np.ndarray:
    """The face (T,) that each triangle of `triangles_of` came from."""
    return np.concatenate([np.arange(len(faces)), np.flatnonzero(faces[:, 3] >= 0)])


def nearest_depth(rays_camera: np.ndarray, vertices_camera: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Depth at which rays from the camera's centre first meet a mesh.

    Parameters
    ----------
    rays_camera
        (n, 3) points or directions in the camera frame, of any length.
    vertices_camera
        (V, 3) vertices in the camera frame, metres.
    triangles
        (T, 3) vertex indices; both sides count, triangles with a vertex at z <= 0 do not.

    Returns
    -------
    numpy.ndarray
        (n,) metres along z; +inf where a ray meets nothing, and for rays with z <= 0.
    """
    z = vertices_camera[:, 2]
    corners = (vertices_camera[:, :2] / np.where(z > 0, z, np.nan)[:, None])[triangles]
    low = np.minimum(np.minimum(corners[:, 0], corners[:, 1]), corners[:, 2])
    high = np.maximum(np.maximum(corners[:, 0], corners[:, 1]), corners[:, 2])
    xy = rays_camera[:, :2] / np.where(rays_camera[:, 2] > 0, rays_camera[:, 2], np.nan)[:, None]
    # which rays pass each triangle's box: by bisection in x, then by comparison in y. NaN (behind the camera) sorts
    # last, so it is within no box
    order = np.argsort(xy[:, 0], kind="stable")
    first = np.searchsorted(xy[order, 0], low[:, 0], side="left")
    count = np.searchsorted(xy[order, 0], high[:, 0], side="right") - first
    count = np.where(np.isnan(low[:, 0]), 0, np.maximum(count, 0))
    face = np.repeat(np.arange(len(triangles)), count)
    within = np.arange(len(face)) - np.repeat(np.cumsum(count) - count, count)
    ray = order[first[face] + within]
    inside = (low[face, 1] <= xy[ray, 1]) & (high[face, 1] >= xy[ray, 1])
    ray, face = ray[inside], face[inside]
    depth = np.full(len(rays_camera), np.inf)
    weights = barycentric(xy[ray], corners[face])
    hit = (weights >= 0.0).all(axis=1)  # NaN (an edge-on triangle) is no hit
    # 1/z is linear over the image plane
    found = 1.0 / (weights[hit] / z[triangles[face[hit]]]).sum(axis=1)
    np.minimum.at(depth, ray[hit], found)
    return depth


def hidden(
    points_camera: np.ndarray, vertices_camera: np.ndarray, triangles: np.ndarray, *, tolerance_m: float
) -> np.ndarray:
    """Whether a mesh stands between the camera's centre and each point.

    Parameters
    ----------
    points_camera
        (n, 3) points in the camera frame, metres; those at z <= 0 count as hidden.
    vertices_camera, triangles
        The mesh, as for `nearest_depth`.
    tolerance_m
        The mesh hides a point only if it is nearer by more than this (a point of a surface is not hidden by it).

    Returns
    -------
    numpy.ndarray
        (n,) bool.
    """
    z = points_camera[:, 2]
    return (z <= 0) | (nearest_depth(points_camera, vertices_camera, triangles) < z - tolerance_m)
