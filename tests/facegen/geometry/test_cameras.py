"""Camera models and rigid motions against OpenCV and against themselves."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.geometry import (
    Camera,
    angles_from_direction,
    angles_from_rotation,
    apply_transform,
    direction_from_angles,
    invert_transform,
    look_at,
    pixel_rays,
    project,
    rotation_from_angles,
    transform,
    unproject,
)

PINHOLE = Camera(
    model="pinhole",
    width=256,
    height=200,
    fx=180,
    fy=190,
    cx=120.3,
    cy=101.2,
    distortion=(-0.28, 0.09, 0.001, -0.0015, -0.012),
)
FISHEYE = Camera(
    model="fisheye",
    width=256,
    height=256,
    fx=95,
    fy=97.5,
    cx=121.3,
    cy=133.2,
    distortion=(0.02, -0.01, 0.003, -0.0004),
)


@pytest.mark.parametrize("camera", [PINHOLE, FISHEYE], ids=lambda c: c.model)
def test_projection_agrees_with_opencv(camera):
    rng = np.random.default_rng(0)
    points = rng.uniform([-0.02, -0.02, 0.03], [0.02, 0.02, 0.08], (200, 3))
    zero = np.zeros(3)
    if camera.model == "pinhole":
        expected = cv2.projectPoints(points, zero, zero, camera.matrix, camera.coefficients)[0][:, 0]
    else:
        expected = cv2.fisheye.projectPoints(points[:, None], zero, zero, camera.matrix, camera.coefficients)[
            0
        ][:, 0]
    np.testing.assert_allclose(project(camera, points), expected, atol=1e-9)


@pytest.mark.parametrize("camera", [PINHOLE, FISHEYE], ids=lambda c: c.model)
def test_unproject_inverts_project_for_every_pixel(camera):
    rays = pixel_rays(camera)
    np.testing.assert_allclose(np.linalg.norm(rays, axis=-1), 1.0, atol=1e-12)
    v, u = np.mgrid[0 : camera.height, 0 : camera.width]
    np.testing.assert_allclose(project(camera, 0.05 * rays), np.stack([u, v], axis=-1), atol=1e-9)


def test_points_behind_a_pinhole_have_no_pixel_and_the_axis_has_the_principal_point():
    assert np.isnan(project(PINHOLE, np.array([0.0, 0.0, -1.0]))).all()
    for camera in (PINHOLE, FISHEYE):
        np.testing.assert_allclose(
            project(camera, np.array([0.0, 0.0, 0.1])), [camera.cx, camera.cy], atol=1e-12
        )
        np.testing.assert_allclose(unproject(camera, np.array([camera.cx, camera.cy])), [0, 0, 1], atol=1e-12)


def test_outermost_pixels_belong_to_the_picture():
    inside = PINHOLE.contains(
        np.array([[-0.5, -0.5], [255.49, 199.49], [-0.51, 0.0], [255.5, 0.0], [0.0, 199.5]])
    )
    assert inside.tolist() == [True, True, False, False, False]


_angle = st.floats(-1.4, 1.4)


@given(_angle, _angle, _angle)
def test_rotations_are_rotations_and_turn_the_gaze_as_named(yaw, pitch, roll):
    rotation = rotation_from_angles(yaw, pitch, roll)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    np.testing.assert_allclose(rotation @ [0, 0, 1], direction_from_angles(yaw, pitch), atol=1e-12)
    np.testing.assert_allclose(
        angles_from_direction(direction_from_angles(yaw, pitch)), (yaw, pitch), atol=1e-9
    )
    np.testing.assert_allclose(angles_from_rotation(rotation), (yaw, pitch, roll), atol=1e-9)


def test_signs_of_angles():
    assert (rotation_from_angles(0.1, 0, 0) @ [0, 0, 1])[0] > 0  # yaw: to the subject's left, +x
    assert (rotation_from_angles(0, 0.1, 0) @ [0, 0, 1])[1] > 0  # pitch: up, +y
    assert (rotation_from_angles(0, 0, 0.1) @ [0, 1, 0])[0] > 0  # roll: the top towards the left shoulder, +x


@given(st.lists(st.floats(-1, 1), min_size=6, max_size=6))
def test_transforms_invert_and_chain(values):
    b_from_a = transform(rotation_from_angles(*values[:3]), np.array(values[3:]))
    points = np.random.default_rng(0).normal(size=(5, 3))
    there = apply_transform(b_from_a, points)
    np.testing.assert_allclose(apply_transform(invert_transform(b_from_a), there), points, atol=1e-12)
    np.testing.assert_allclose(
        apply_transform(b_from_a @ b_from_a, points), apply_transform(b_from_a, there), atol=1e-12
    )


def test_look_at_puts_the_target_on_the_axis_and_up_upwards():
    head_from_camera = look_at(np.array([0.01, -0.02, 0.06]), np.array([0.03, 0.0, 0.0]))
    camera_from_head = invert_transform(head_from_camera)
    target = apply_transform(camera_from_head, np.array([[0.03, 0.0, 0.0]]))[0]
    np.testing.assert_allclose(target[:2], 0, atol=1e-12)
    assert target[2] == pytest.approx(np.linalg.norm([0.02, 0.02, -0.06]))
    up = camera_from_head[:3, :3] @ [0, 1, 0]
    assert up[1] < 0  # y points down in the camera frame
    assert np.linalg.det(head_from_camera[:3, :3]) == pytest.approx(1.0)
