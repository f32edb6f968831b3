"""Assembling a scene: no face gets lost, and cameras and lamps stand where the headset is."""

import numpy as np
import pytest

from facegen.conventions import Part
from facegen.errors import InputError
from facegen.geometry import apply_transform, direction_from_angles, invert_transform, project
from facegen.headsets import head_from_headset, load_headset
from facegen.rigs import evaluate, eye_geometry
from facegen.scene import MATERIALS, assemble, material_values


@pytest.fixture(scope="module")
def scene(anny):
    axis = np.broadcast_to(direction_from_angles(0.0, 0.0), (1, 2, 3))
    face = evaluate(anny, np.zeros((1, anny.components)), np.zeros((1, 52)), axis)
    eyes = [
        eye_geometry(c, r, a) for c, r, a in zip(face.eye_center[0], face.eye_radius[0], axis[0], strict=True)
    ]
    headset = load_headset("tracking3")
    placed = head_from_headset(headset, face.landmarks[0, 27], np.zeros(6))
    return assemble(anny, face.vertices[0], eyes, headset, placed)


def test_no_face_of_the_rig_is_lost(scene, anny):
    head = [mesh for mesh in scene.meshes if not mesh.name.startswith(("left_", "right_", "headset"))]
    strips = (anny.part == Part.LASHES).sum()  # they guide lashes and are not drawn
    assert sum(len(mesh.faces) for mesh in head) == len(anny.faces) - strips
    for mesh in head:
        assert mesh.faces.max() == len(mesh.vertices) - 1
        assert mesh.face_material.max() < len(mesh.materials)


def test_names_are_unique_and_materials_known(scene):
    names = [mesh.name for mesh in scene.meshes]
    assert len(set(names)) == len(names)
    assert {name for mesh in scene.meshes for name in mesh.materials} <= set(MATERIALS)


def test_eyes_are_framed_as_real_headsets_frame_them(scene, anny):
    for side, index in (("left", 0), ("right", 1)):
        view = next(view for view in scene.views if view.name == f"{side}_eye")
        iris = next(mesh for mesh in scene.meshes if mesh.name == f"{side}_iris")
        rim = iris.vertices[-96:]
        pixels = project(view.camera, apply_transform(view.camera_from_head, rim))
        size = np.array([view.camera.width, view.camera.height])
        assert np.allclose(pixels.mean(axis=0) / size, [0.5, 0.6], atol=0.06), index
        assert view.lamps == tuple(lamp.name for lamp in scene.lamps if lamp.name.startswith(f"{side}_eye"))
        assert len(view.lamps) == 6


def test_headset_carries_cameras_and_lamps_along(anny, scene):
    headset = load_headset("tracking3")
    shift = np.array([2e-3, -1e-3, 3e-3, 0.0, 0.0, 0.0])
    moved = assemble(
        anny,
        anny.vertices,
        [_eye(anny, i) for i in (0, 1)],
        headset,
        head_from_headset(headset, np.zeros(3), shift),
    )
    rest = assemble(
        anny,
        anny.vertices,
        [_eye(anny, i) for i in (0, 1)],
        headset,
        head_from_headset(headset, np.zeros(3), np.zeros(6)),
    )
    for a, b in zip(moved.views, rest.views, strict=True):
        step = invert_transform(a.camera_from_head)[:3, 3] - invert_transform(b.camera_from_head)[:3, 3]
        assert np.allclose(step, shift[:3])
    for a, b in zip(moved.lamps, rest.lamps, strict=True):
        assert np.allclose(a.position - b.position, shift[:3])


def _eye(anny, index):
    return eye_geometry(anny.eye_center[index], anny.eye_radius[index], np.array([0.0, 0.0, 1.0]))


def test_unknown_materials_and_parameters_are_refused():
    with pytest.raises(InputError, match="there is no material 'gold'; known are skin"):
        material_values("gold", {})
    with pytest.raises(InputError, match="material 'iris' has no parameter 'colour'; known are albedo"):
        material_values("iris", {"colour": 1.0})
    assert material_values("iris", {"albedo": 0.5})["albedo"] == 0.5
