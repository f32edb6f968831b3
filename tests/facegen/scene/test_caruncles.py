"""The mounds in the eyes' inner corners: between the lids, and flat where these pass each other."""

import numpy as np

from facegen.rigs import evaluate
from facegen.scene.lids import CARUNCLE_IN_M, CARUNCLE_LEAST_M, caruncle_meshes
from tests.facegen.rigs.people import people, straight, weights

COUNT = 6
UNEVEN = 0.08


def height_m(rig, vertices: np.ndarray, eye_center: np.ndarray, side: int) -> float:
    """Root mean square distance of a caruncle's points from the line along the eye through their middle."""
    mesh = caruncle_meshes(rig, vertices, eye_center)[side]
    inner, outer = vertices[rig.upper_lid[side][[0, -1]]]
    along = (outer - inner) / np.linalg.norm(outer - inner)
    assert ((mesh.vertices - inner) @ along).min() > -UNEVEN * CARUNCLE_IN_M - 1e-9  # it ends at the corner
    off = mesh.vertices - mesh.vertices.mean(axis=0)
    off -= np.outer(off @ along, along)
    return float(np.sqrt(np.square(off).sum(axis=1).mean()))


def test_caruncles_end_at_the_corner_and_are_flat_where_lids_pass_each_other(anny):
    faces = evaluate(anny, people(anny, COUNT), weights(COUNT), straight(COUNT))
    for vertices, eye_center in zip(faces.vertices, faces.eye_center, strict=True):
        for side in range(2):
            assert height_m(anny, vertices, eye_center, side) > 10 * CARUNCLE_LEAST_M
            passed = vertices.copy()
            passed[anny.upper_lid[side], 1] -= 20e-3
            assert height_m(anny, passed, eye_center, side) < (1 + UNEVEN) * CARUNCLE_LEAST_M
