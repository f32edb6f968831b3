"""Occlusion and z-buffer against spheres and planes whose answer is known."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.raster import hidden, nearest_triangles, triangles_of

SQUARE = np.array([[-1.0, -1.0, 2.0], [1.0, -1.0, 2.0], [1.0, 1.0, 2.0], [-1.0, 1.0, 2.0]])
QUAD = np.array([[0, 1, 2, 3]])


def test_quads_become_two_triangles_and_triangles_stay():
    faces = np.array([[0, 1, 2, 3], [4, 5, 6, -1]])
    assert sorted(map(tuple, triangles_of(faces))) == [(0, 1, 2), (0, 2, 3), (4, 5, 6)]


@settings(deadline=None)  # the first call compiles
@given(st.floats(-0.9, 0.9), st.floats(-0.9, 0.9))
def test_a_square_hides_what_is_behind_it_and_nothing_else(x, y):
    behind = np.array([2 * x, 2 * y, 4.0])
    points = np.stack([behind, behind * 0.4, behind * 0.5, [3.0 * np.sign(x or 1), y, 2.5], [x, y, -1.0]])
    result = hidden(points, SQUARE, triangles_of(QUAD), tolerance_m=1e-6)
    assert result.tolist() == [True, False, False, False, True]


def test_tolerance_lets_a_surface_not_hide_its_own_points():
    point = np.array([[0.1, 0.1, 2.001]])
    triangles = triangles_of(QUAD)
    assert hidden(point, SQUARE, triangles, tolerance_m=0.0005).tolist() == [True]
    assert hidden(point, SQUARE, triangles, tolerance_m=0.002).tolist() == [False]


def test_triangles_behind_the_camera_hide_nothing():
    vertices = SQUARE * [1, 1, -1]
    assert hidden(np.array([[0.0, 0.0, 5.0]]), vertices, triangles_of(QUAD), tolerance_m=0).tolist() == [
        False
    ]


def _sphere(center: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    rows, columns = 60, 120
    theta, phi = np.linspace(0, np.pi, rows), np.arange(columns) * 2 * np.pi / columns
    t, p = np.meshgrid(theta, phi, indexing="ij")
    unit = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns), indexing="ij")
    k = (j + 1) % columns
    faces = np.stack(
        [i * columns + j, i * columns + k, (i + 1) * columns + k, (i + 1) * columns + j], axis=-1
    )
    return center + radius * unit, triangles_of(faces.reshape(-1, 4))


def test_depth_of_a_sphere_is_its_formula():
    center, radius, size = np.array([0.01, -0.005, 0.2]), 0.05, 96
    vertices, triangles = _sphere(center, radius)
    focal = 100.0
    plane = vertices[:, :2] / vertices[:, 2:] * focal + (size - 1) / 2
    drawn = nearest_triangles(plane, 1 / vertices[:, 2], triangles, shape=(size, size))
    triangle = drawn.triangle
    depth = np.where(triangle >= 0, 1 / np.where(triangle >= 0, drawn.value, 1.0), np.inf)
    v, u = np.mgrid[0:size, 0:size]
    ray = np.stack(
        [(u - (size - 1) / 2) / focal, (v - (size - 1) / 2) / focal, np.ones_like(u, float)], axis=-1
    )
    a, b, c = (ray * ray).sum(-1), ray @ center, center @ center - radius**2
    root = b * b - a * c
    expected = np.where(root > 0, (b - np.sqrt(np.maximum(root, 0))) / a, np.inf)
    assert ((triangle >= 0) == np.isfinite(depth)).all()
    # facets of 3 degrees stand up to r (1 - cos 1.5 deg) = 0.017 mm inside the sphere, more along grazing rays
    well_inside = root > 0.3 * root.max()
    assert np.abs(depth[well_inside] - expected[well_inside]).max() < 1e-4
    differs = np.isfinite(depth) != np.isfinite(expected)
    assert differs.mean() < 0.01


@pytest.mark.parametrize("seed", range(3))
def test_occlusion_agrees_with_the_z_buffer(seed):
    rng = np.random.default_rng(seed)
    vertices, triangles = _sphere(np.array([0.0, 0.0, 0.3]), 0.05)
    size, focal = 64, 100.0
    pixels = rng.integers(4, 60, (40, 2))
    z = rng.uniform(0.2, 0.4, 40)
    points = np.concatenate([(pixels - (size - 1) / 2) / focal * z[:, None], z[:, None]], axis=1)
    plane = vertices[:, :2] / vertices[:, 2:] * focal + (size - 1) / 2
    drawn = nearest_triangles(plane, 1 / vertices[:, 2], triangles, shape=(size, size))
    depth = 1 / np.where(drawn.triangle >= 0, drawn.value, 1e-300)
    expected = depth[pixels[:, 1], pixels[:, 0]] < z - 1e-4
    assert (hidden(points, vertices, triangles, tolerance_m=1e-4) == expected).all()
