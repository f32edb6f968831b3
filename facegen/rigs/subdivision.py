"""Catmull-Clark subdivision as a sparse matrix, so that shapes and displacements subdivide alike.

References
----------
.. [1] E. Catmull and J. Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes",
   Computer-Aided Design 10(6), 1978. Open boundaries follow the cubic B-spline of their edges.
"""

from dataclasses import dataclass

import numpy as np
from scipy import sparse


@dataclass(frozen=True, kw_only=True, eq=False)
class Subdivision:
    """One step of subdivision of a quad mesh with V vertices, E edges and F faces.

    Attributes
    ----------
    matrix
        (V + E + F, V) sparse: new vertices are the old ones (smoothed, in their order), then edges, then
        faces.
    faces
        (4 F, 4) int32; face f becomes faces 4 f to 4 f + 3, the one at its corner c being 4 f + c.
    """

    matrix: sparse.csr_matrix
    faces: np.ndarray

    def __call__(self, values: np.ndarray) -> np.ndarray:
        """Values per vertex (..., V, 3) on the new vertices (..., V + E + F, 3)."""
        flat = np.moveaxis(values, -2, 0).reshape(values.shape[-2], -1)
        new = (self.matrix @ flat).reshape(-1, *values.shape[:-2], values.shape[-1])
        return np.moveaxis(new, 0, -2)


def catmull_clark(quads: np.ndarray, vertex_count: int) -> Subdivision:
    """Subdivide ``quads`` (F, 4) over ``vertex_count`` vertices once.

    Every edge must belong to one face (boundary) or two, as in any manifold mesh.
    """
    faces = len(quads)
    corners = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    edges, edge_of_side = np.unique(np.sort(corners, axis=1), axis=0, return_inverse=True)
    edge_of_side = edge_of_side.reshape(faces, 4)
    sides = np.bincount(edge_of_side.ravel(), minlength=len(edges))
    if sides.max() > 2:
        raise ValueError("an edge of the mesh belongs to more than two faces")
    boundary = sides == 1

    def matrix(rows: np.ndarray, columns: np.ndarray, shape: tuple[int, int]) -> sparse.csr_matrix:
        return sparse.csr_matrix((np.ones(rows.size), (rows.ravel(), columns.ravel())), shape)

    face_point = matrix(np.repeat(np.arange(faces), 4), quads, (faces, vertex_count)) / 4.0
    edge_middle = matrix(np.repeat(np.arange(len(edges)), 2), edges, (len(edges), vertex_count)) / 2.0
    faces_of_edge = matrix(edge_of_side, np.repeat(np.arange(faces), 4), (len(edges), faces))
    inner_edge = 0.5 * (edge_middle + 0.5 * faces_of_edge @ face_point)
    edge_point = sparse.diags(boundary * 1.0) @ edge_middle + sparse.diags(~boundary * 1.0) @ inner_edge

    faces_of_vertex = matrix(quads, np.repeat(np.arange(faces), 4), (vertex_count, faces))
    edges_of_vertex = matrix(edges, np.repeat(np.arange(len(edges)), 2), (vertex_count, len(edges)))
    valence = np.maximum(np.asarray(edges_of_vertex.sum(axis=1)).ravel(), 1.0)
    face_valence = np.maximum(np.asarray(faces_of_vertex.sum(axis=1)).ravel(), 1.0)
    identity = sparse.identity(vertex_count)
    inner_vertex = (
        sparse.diags(1.0 / (valence * face_valence)) @ faces_of_vertex @ face_point
        + sparse.diags(2.0 / valence**2) @ edges_of_vertex @ edge_middle
        + sparse.diags(1.0 - 3.0 / valence) @ identity
    )
    at_boundary = edges_of_vertex @ sparse.diags(boundary * 1.0)
    boundary_vertex = 0.5 * identity + 0.25 * at_boundary @ edge_middle
    on_boundary = np.asarray(at_boundary.sum(axis=1)).ravel() > 0
    loose = np.asarray(edges_of_vertex.sum(axis=1)).ravel() == 0  # belongs to no face: stays where it is
    vertex_point = (
        sparse.diags((on_boundary & ~loose) * 1.0) @ boundary_vertex
        + sparse.diags((~on_boundary & ~loose) * 1.0) @ inner_vertex
        + sparse.diags(loose * 1.0)
    )
    side = vertex_count + edge_of_side
    centre = np.repeat(vertex_count + len(edges) + np.arange(faces)[:, None], 4, axis=1)
    new_faces = np.stack([quads, side, centre, np.roll(side, 1, axis=1)], axis=-1)
    return Subdivision(
        matrix=sparse.vstack([vertex_point, edge_point, face_point]).tocsr(),
        faces=new_faces.reshape(-1, 4).astype(np.int32),
    )


def subdivide_corners(values: np.ndarray) -> np.ndarray:
    """Bilinear corner values (4 F, 4, n), as UVs, of the faces that `catmull_clark` makes of (F, 4, n)."""
    middle = 0.5 * (values + np.roll(values, -1, axis=1))
    centre = np.broadcast_to(values.mean(axis=1, keepdims=True), values.shape)
    return np.stack([values, middle, centre, np.roll(middle, 1, axis=1)], axis=2).reshape(
        -1, 4, values.shape[-1]
    )
