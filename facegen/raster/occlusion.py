"""Which points a mesh hides from a camera."""

import numpy as np


def triangles_of(faces: np.ndarray) -> np.ndarray:
    """Triangles (T, 3) of faces (F, 4) whose missing fourth corner is -1; quads are cut along their first diagonal."""
    quads = faces[faces[:, 3] >= 0]
    return np.concatenate([faces[:, :3], quads[:, [0, 2, 3]]]).astype(np.int64)


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
    np.minimum.at(depth, ray, depth_on_triangles(xy[ray], corners[face], 1.0 / z[triangles[face]]))
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


def depth_on_triangles(xy: np.ndarray, corners: np.ndarray, inverse_z: np.ndarray) -> np.ndarray:
    """Depth (m,) of triangles (m, 3, 2) with 1/z (m, 3) at image-plane points (m, 2); +inf outside the triangle."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]

    def cross(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    area = cross(b - a, c - a)
    safe = np.where(area == 0, np.nan, area)
    wa, wb = cross(b - xy, c - xy) / safe, cross(c - xy, a - xy) / safe
    wc = 1.0 - wa - wb
    inside = (wa >= 0) & (wb >= 0) & (wc >= 0)  # NaN (an edge-on triangle) is never inside
    # 1/z is linear on the image plane
    with np.errstate(divide="ignore"):
        depth = 1.0 / (wa * inverse_z[:, 0] + wb * inverse_z[:, 1] + wc * inverse_z[:, 2])
    return np.where(inside, depth, np.inf)
