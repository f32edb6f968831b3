"""Eye meshes: closed, outward, human-sized, and where `EyeGeometry` says."""

import numpy as np
import pytest

from facegen.conventions import Part
from facegen.geometry import direction_from_angles
from facegen.rigs import eye_geometry, lid_support_radius
from facegen.scene import eye_meshes
from facegen.scene.eyes import head_from_eye

EYES = [
    eye_geometry(np.array([0.031, 0.0, 0.0]), 0.0166, direction_from_angles(0.3, -0.2)),
    eye_geometry(
        np.array([-0.031, 0.001, 0.002]), 0.012, direction_from_angles(0.0, 0.0), pupil_radius=3.5e-3
    ),
]


@pytest.fixture(params=EYES, ids=["oversized", "human"])
def eye(request):
    return request.param


def parts(eye) -> dict:
    return {mesh.name.removeprefix("left_"): mesh for mesh in eye_meshes(eye, "left")}


def test_the_outer_surface_is_the_one_that_lids_rest_on(eye):
    for name in ("sclera", "cornea"):
        away = parts(eye)[name].vertices - eye.center
        distance = np.linalg.norm(away, axis=-1)
        assert np.allclose(
            distance, lid_support_radius(away / distance[:, None], eye.radius, eye.axis), atol=1e-9
        )


def test_cornea_and_sclera_meet_at_the_limbus(eye):
    meshes = parts(eye)
    rim, start = meshes["cornea"].vertices[-96:], meshes["sclera"].vertices[:96]
    assert np.allclose(rim, start, atol=1e-12)
    along = (rim - eye.center) @ eye.axis
    assert np.allclose(along, eye.limbus_offset)


def test_iris_plane_and_pupil_hole(eye):
    iris = parts(eye)["iris"]
    along = (iris.vertices - eye.center) @ eye.axis
    aside = np.linalg.norm(iris.vertices - eye.center - along[:, None] * eye.axis, axis=-1)
    assert np.allclose(along, eye.iris_plane_offset)
    assert np.isclose(aside.min(), eye.pupil_radius)
    assert (
        eye.limbus_radius
        < aside.max()
        < np.sqrt(eye.radius**2 - (eye.iris_plane_offset - eye.sclera_center_offset) ** 2)
    )
    assert iris.uv[..., 1].min() == 0.0
    assert iris.uv[..., 0].min() == 0.0
    assert iris.uv[..., 0].max() == 1.0


def test_faces_point_outwards(eye):
    for name, mesh in parts(eye).items():
        a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in (1, 2, 3))
        normal = np.cross(b - a, c - a)
        outwards = (
            eye.axis if name in ("iris", "pupil") else mesh.vertices[mesh.faces].mean(axis=1) - eye.center
        )
        facing = (normal * outwards).sum(axis=-1)
        assert (facing > -1e-18).all(), name


def test_parts_and_names(eye):
    assert [(m.name, Part(int(m.part[0]))) for m in eye_meshes(eye, "right")] == [
        ("right_sclera", Part.SCLERA),
        ("right_iris", Part.IRIS),
        ("right_pupil", Part.PUPIL),
        ("right_cornea", Part.CORNEA),
    ]


def test_the_eyes_own_frame_is_upright(eye):
    pose = head_from_eye(eye)
    assert np.allclose(pose[:3, :3].T @ pose[:3, :3], np.eye(3))
    assert np.isclose(np.linalg.det(pose[:3, :3]), 1.0)
    assert np.allclose(pose[:3, 2], eye.axis)
    assert pose[1, 1] > 0.9
