"""Pieces that builds are made of: subdivision, spheres, components, the z-buffer, the eye's surface."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.raster import faces_of_triangles, nearest_along_z, triangles_of
from facegen.rigs.eyes import CORNEA_RADIUS_M, IRIS_RADIUS_M, eye_geometry, lid_support_radius, visual_axis
from facegen.rigs.human_eyes import EYE_RADIUS_M
from facegen.rigs.identity import fit_sphere, principal_components, regress_traits
from facegen.rigs.subdivision import catmull_clark, subdivide_corners

CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
CUBE_FACES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def test_subdivided_cube() -> None:
    """Catmull and Clark's rules on a cube: corners to 5/9, edges to 3/4, faces stay."""
    step = catmull_clark(CUBE_FACES, 8)
    points = step(CUBE)
    assert points.shape == (26, 3)
    assert step.faces.shape == (24, 4)
    np.testing.assert_allclose(points[:8], CUBE * 5.0 / 9.0)
    np.testing.assert_allclose(np.sort(np.abs(points[8:20]), axis=1), [[0.0, 0.75, 0.75]] * 12)
    np.testing.assert_allclose(np.sort(np.abs(points[20:]), axis=1), [[0.0, 0.0, 1.0]] * 6)
    np.testing.assert_allclose(points[step.faces[::4, 2]], CUBE[CUBE_FACES].mean(axis=1))


def test_boundary_follows_its_own_curve() -> None:
    grid = np.array([[x, y, 0.0] for y in range(3) for x in range(3)])
    faces = np.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
    points = catmull_clark(faces, 9)(grid)
    np.testing.assert_allclose(points[1], grid[1])
    np.testing.assert_allclose(points[4], grid[4])
    np.testing.assert_allclose(points[0], (0.125, 0.125, 0.0))


def test_corner_values_stay_with_their_corners() -> None:
    step = catmull_clark(CUBE_FACES, 8)
    fine = subdivide_corners(CUBE[CUBE_FACES])
    np.testing.assert_allclose(fine[:, 0], CUBE[CUBE_FACES].reshape(-1, 3))
    np.testing.assert_array_equal(step.faces[:, 0], CUBE_FACES.ravel())


@given(st.integers(0, 1000))
def test_sphere_fit_is_exact_on_spheres(seed: int) -> None:
    rng = np.random.Generator(np.random.PCG64(seed))
    centre, radius = rng.normal(size=(2, 3)), rng.uniform(0.5, 2.0, 2)
    direction = rng.normal(size=(2, 30, 3))
    direction /= np.linalg.norm(direction, axis=-1, keepdims=True)
    found_centre, found_radius = fit_sphere(centre[:, None] + radius[:, None, None] * direction)
    np.testing.assert_allclose(found_centre, centre, atol=1e-9)
    np.testing.assert_allclose(found_radius, radius, atol=1e-9)


def test_components_rebuild_samples_and_have_unit_scores() -> None:
    rng = np.random.Generator(np.random.PCG64(5))
    samples = rng.normal(size=(40, 3)) @ rng.normal(size=(3, 12)) + 2.0
    basis = principal_components(samples, 3)
    np.testing.assert_allclose(basis.mean + basis.scores @ basis.components, samples, atol=1e-9)
    np.testing.assert_allclose(basis.scores.std(axis=0, ddof=1), 1.0)
    traits = np.stack([np.ones(40), np.arange(40) % 2], axis=1)
    mean, residual = regress_traits(basis.scores, traits)
    left = basis.scores - traits @ mean.T
    np.testing.assert_allclose(residual @ residual.T, left.T @ left / 40)


def test_z_buffer_keeps_the_nearest() -> None:
    square = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
    vertices = np.concatenate([square, 0.5 * square + (0.0, 0.0, 1.0)])
    faces = np.array([[0, 1, 2, 3], [4, 5, 6, -1]])
    triangles, source = triangles_of(faces), faces_of_triangles(faces)
    depth = nearest_along_z(vertices, triangles, origin=np.array([-1.45, 1.45]), step=0.1, shape=(30, 30))
    assert (depth.value == 0.0).sum() + (depth.value == 1.0).sum() == 400
    assert set(source[np.unique(depth.triangle[depth.triangle >= 0])]) == {0, 1}
    assert 40 <= (depth.value == 1.0).sum() <= 60


@pytest.mark.parametrize("radius", [0.012, 0.0166])
def test_cornea_meets_the_sclera_at_the_limbus(radius: float) -> None:
    eye = eye_geometry(np.zeros(3), radius, np.array([0.0, 0.0, 1.0]))
    angle = np.arctan2(IRIS_RADIUS_M, eye.limbus_offset) + np.array([-1e-6, 1e-6])
    direction = np.stack([np.sin(angle), np.zeros(2), np.cos(angle)], axis=-1)
    limbus = np.hypot(IRIS_RADIUS_M, eye.limbus_offset)
    np.testing.assert_allclose(lid_support_radius(direction, radius, eye.axis), limbus, rtol=1e-5)
    sclera = np.array([0.0, radius, eye.sclera_center_offset])
    reach = np.linalg.norm(sclera)
    np.testing.assert_allclose(lid_support_radius(sclera / reach, radius, eye.axis), reach)
    apex = lid_support_radius(eye.axis, radius, eye.axis)
    np.testing.assert_allclose(apex, eye.cornea_center_offset + CORNEA_RADIUS_M)
    assert eye.iris_plane_offset < eye.limbus_offset < apex
    if radius == EYE_RADIUS_M:
        np.testing.assert_allclose(apex, 13.5e-3, atol=1e-5)


def test_visual_axes_converge() -> None:
    left, right = visual_axis(np.tile((0.0, 0.0, 1.0), (2, 1)))
    assert left[0] < 0.0 < right[0]
    np.testing.assert_allclose(np.degrees(np.arcsin(right[0])), 5.0, atol=0.01)
