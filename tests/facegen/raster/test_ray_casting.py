"""The compiled loop of occlusion against plain formulas, on random meshes and on faces in wide poses."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.geometry import apply_transform, rotation_from_angles, transform
from facegen.raster import hidden, hidden_by_own, nearest_depth, triangles_of
from facegen.raster.z_buffer import barycentric
from facegen.rigs import Rig, evaluate
from facegen.sampling.cameras import FACING

FACES = 12


def plain_depth(rays: np.ndarray, vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Depth (p,) of the nearest hit: every ray with every triangle, no culling."""
    z = vertices[:, 2]
    triangles = triangles[(z[triangles] > 0).all(axis=1)]
    depth = np.full(len(rays), np.inf)
    corners = (vertices[:, :2] / z[:, None])[triangles]
    for ray, (x, y, along) in enumerate(rays):
        if along > 0 and len(triangles):
            weights = barycentric(np.broadcast_to([x / along, y / along], (len(triangles), 2)), corners)
            hit = (weights >= 0).all(axis=1)
            found = 1.0 / (weights[hit] / z[triangles[hit]]).sum(axis=1)
            depth[ray] = found.min(initial=np.inf)
    return depth


@settings(deadline=None, max_examples=40)  # the first call compiles
@given(seed=st.integers(0, 2**32 - 1), spread=st.sampled_from([0.0, 0.01, 0.3, 3.0]))
def test_random_meshes_are_hit_where_the_formula_says(seed: int, spread: float) -> None:
    rng = np.random.default_rng(seed)
    vertices = rng.normal([0.0, 0.0, 1.0], [0.5, 0.5, 0.6], (30, 3))  # some lie behind the camera
    faces = rng.integers(0, 30, (25, 4)).astype(np.int32)
    faces[rng.random(25) < 0.4, 3] = -1
    rays = np.concatenate([rng.normal(0.0, spread, (20, 2)), rng.uniform(-0.2, 1.0, (20, 1))], axis=1)
    expected = plain_depth(rays, vertices, triangles_of(faces))
    np.testing.assert_allclose(nearest_depth(rays, vertices, faces), expected, rtol=1e-9)
    np.testing.assert_allclose(nearest_depth(rays, vertices, triangles_of(faces)), expected, rtol=1e-9)


def test_no_ray_slips_between_faces() -> None:
    """Rays through the vertices and along the edges of a wall meet it, wherever the camera is turned."""
    x, y = np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9))
    wall = np.stack([x, y, np.full_like(x, 3.0)], axis=-1).reshape(-1, 3)
    index = np.arange(81).reshape(9, 9)
    quads = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    inner = index[1:-1, 1:-1].ravel()
    between = (wall[index[1:-1, 1:-1]] + wall[index[2:, 2:]]).reshape(-1, 3) / 2  # the quads' diagonals
    for turn in np.linspace(-0.5, 0.5, 25):
        camera = transform(rotation_from_angles(turn, 0.3 * turn, 2 * turn), np.zeros(3))
        rays = apply_transform(camera, np.concatenate([wall[inner], between]) * 1.5)
        assert np.isfinite(nearest_depth(rays, apply_transform(camera, wall), quads)).all()


def wide_poses(count: int) -> np.ndarray:
    """Cameras (count, 4, 4) before heads turned as far as a spec allows and beyond."""
    rng = np.random.default_rng(8)
    yaw, pitch, roll = (np.radians(limit) * rng.uniform(-1, 1, count) for limit in (75.0, 45.0, 90.0))
    position = rng.uniform([-0.2, -0.2, 0.25], [0.2, 0.2, 1.2], (count, 3))
    return transform(FACING @ rotation_from_angles(yaw, pitch, roll), position)


def test_all_flags_of_faces_in_wide_poses_are_those_of_the_formula(anny: Rig) -> None:
    rng = np.random.default_rng(4)
    gaze = np.tile((0.0, 0.0, 1.0), (FACES, 2, 1))
    faces = evaluate(
        anny, rng.standard_normal((FACES, anny.components)), rng.random((FACES, 52)), gaze, cage_only=True
    )
    cameras = wide_poses(FACES)
    points = apply_transform(cameras, faces.landmarks)
    found = hidden_by_own(points, faces.vertices, cameras, anny.cage_faces, tolerance_m=2e-3)
    triangles = triangles_of(anny.cage_faces)
    meshes = apply_transform(cameras, faces.vertices)
    expected = [
        plain_depth(p, mesh, triangles) < p[:, 2] - 2e-3 for p, mesh in zip(points, meshes, strict=True)
    ]
    assert 0.15 < np.mean(expected) < 0.85
    np.testing.assert_array_equal(found, expected)
    one = hidden(points[7], meshes[7], anny.cage_faces, tolerance_m=2e-3)
    np.testing.assert_array_equal(one, expected[7])


@pytest.mark.slow
def test_works_where_no_cache_can_be_written(tmp_path: Path) -> None:
    """A read-only installation and home, as in a container: each process compiles for itself."""
    blocked = tmp_path / "file"
    blocked.write_text("a file where Numba wants a folder")
    code = (
        "import numpy as np, numba.core.caching as c\n"
        "c.CacheImpl._locator_classes = []\n"  # as if none of its folders could be written
        "from facegen.raster import nearest_depth\n"
        "wall = np.array([[-1, -1, 2], [1, -1, 2], [0, 1, 2.0]])\n"
        "print(nearest_depth(np.array([[0, 0, 1.0]]), wall, np.array([[0, 1, 2]])))\n"
    )
    environ = dict(os.environ) | {"NUMBA_CACHE_DIR": str(blocked), "HOME": str(blocked)}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environ, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[2.]"
