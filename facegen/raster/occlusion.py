"""Which points a mesh hides from a camera."""

import numpy as np


def triangles_of(faces: np.ndarray) -> np.ndarray:
    """Triangles (T, 3) of faces (F, 4) whose missing fourth corner is -1; quads are cut along their first diagonal."""
    quads = faces[faces[:, 3] >= 0]
    return np.concatenate([faces[:, :3], quads[:, [0, 2, 3]]]).astype(np.int64)


def faces_of_triangles(faces: np.ndarray) -> np.ndarray:
    """The face (T,) that each triangle of `triangles_of` came from."""
    return np.concatenate([np.arange(len(faces)), np.flatnonzero(faces[:, 3] >= 0)])


def nearest_depth(rays_camera: np.ndarray, vertices_camera: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Depth at which rays from the camera's centre first meet a mesh.

    Parameters
    ----------
    rays_camera
        (p, 3) points or directions in the camera frame, of any length.
    vertices_camera
        (V, 3) vertices in the camera frame, metres.
    faces
        (F, 3) triangles, or (F, 4) quads, cut along their first diagonal, and triangles padded with -1; both sides
        count, triangles with a vertex at z <= 0 do not.

    Returns
    -------
    numpy.ndarray
        (p,) metres along z; +inf where a ray meets nothing, and for rays with z <= 0.
    """
    return _nearest_depth(rays_camera[None], vertices_camera[None], np.eye(4)[None], faces)[0]


def hidden(
    points_camera: np.ndarray, vertices_camera: np.ndarray, faces: np.ndarray, *, tolerance_m: float
) -> np.ndarray:
    """Whether a mesh stands between the camera's centre and each point.

    Parameters
    ----------
    points_camera
        (p, 3) points in the camera frame, metres; those at z <= 0 count as hidden.
    vertices_camera, faces
        The mesh, as for `nearest_depth`.
    tolerance_m
        The mesh hides a point only if it is nearer by more than this (a point of a surface is not hidden by it).

    Returns
    -------
    numpy.ndarray
        (p,) bool.
    """
    return hidden_by_own(
        points_camera[None], vertices_camera[None], np.eye(4)[None], faces, tolerance_m=tolerance_m
    )[0]


def hidden_by_own(
    points_camera: np.ndarray,
    vertices: np.ndarray,
    camera_from_mesh: np.ndarray,
    faces: np.ndarray,
    *,
    tolerance_m: float,
) -> np.ndarray:
    """`hidden` for n sets of points (n, p, 3), each with its own mesh and camera: (n, p) bool.

    ``vertices`` (n, V, 3), which share ``faces``, are in the frames that ``camera_from_mesh`` (n, 4, 4) leads from.
    """
    z = points_camera[..., 2]
    return (z <= 0) | (_nearest_depth(points_camera, vertices, camera_from_mesh, faces) < z - tolerance_m)


def _nearest_depth(
    rays_camera: np.ndarray, vertices: np.ndarray, camera_from_mesh: np.ndarray, faces: np.ndarray
) -> np.ndarray:
    from facegen.raster.ray_casting import cast_rays  # imports Numba

    last = faces[:, -1:]
    corners = np.concatenate([faces[:, :3], np.where(last >= 0, last, faces[:, 2:3])], axis=1)
    z = rays_camera[..., 2:]
    rays = rays_camera[..., :2] / np.where(z > 0, z, np.nan)
    inverse_depth = np.empty(rays.shape[:2])
    # one type and layout of each array, so that the loop is compiled once
    cast_rays(
        np.ascontiguousarray(rays, np.float64),
        np.ascontiguousarray(vertices, np.float64),
        np.ascontiguousarray(camera_from_mesh, np.float64),
        np.ascontiguousarray(corners, np.uint32),
        inverse_depth,
    )
    return np.divide(1.0, inverse_depth, out=np.full(inverse_depth.shape, np.inf), where=inverse_depth > 0)
