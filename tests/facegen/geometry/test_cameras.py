"""Camera models and rigid motions against OpenCV and against themselves."""

from dataclasses import replace

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
    turning_radius,
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


_coefficient = st.integers(-400, 400).map(lambda thousandths: thousandths / 1000.0)
_small = st.integers(-20, 20).map(lambda thousandths: thousandths / 1000.0)


@st.composite
def _cameras(draw):
    """Lenses of either model, weak and strong; half of the pinholes without tangential terms."""
    model = draw(st.sampled_from(["pinhole", "fisheye"]))
    radial = draw(st.tuples(*[_coefficient] * 3))
    if model == "fisheye":
        distortion = (*radial, draw(_small))
    else:
        tangential = draw(st.one_of(st.just((0.0, 0.0)), st.tuples(_small, _small)))
        distortion = (*radial[:2], *tangential, radial[2])
    return Camera(
        model=model, width=256, height=256, fx=100, fy=100, cx=127.5, cy=127.5, distortion=distortion
    )


@given(_cameras(), st.floats(0.0, 2.0 * np.pi))
def test_a_lens_keeps_rays_in_their_order_and_shows_none_beyond_its_turning_point(camera, turn):
    angle = np.linspace(0.0, np.pi, 721)[1:]
    end = turning_radius(camera)
    if camera.model == "pinhole":
        angle, end = angle[angle < np.radians(85.0)], np.arctan(end)
    rays = np.stack([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)], axis=-1)
    pixels = project(camera, rays)
    seen = np.isfinite(pixels).all(axis=-1)
    assert (seen == (angle < end)).all()
    outwards = (pixels - [camera.cx, camera.cy]) @ [np.cos(turn), np.sin(turn)]
    assert (np.diff(outwards[seen], prepend=0.0) > 0.0).all()


@given(_cameras(), st.integers(0, 2**32 - 1))
def test_every_point_with_a_pixel_lies_on_this_pixels_ray(camera, seed):
    rays = np.random.default_rng(seed).normal(size=(200, 3))
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    if camera.model == "pinhole":
        rays = rays[
            rays[:, 2] > 0.05
        ]  # a polynomial of the seventh degree leaves no digits beside the camera
    pixels = project(camera, 0.05 * rays)
    seen = np.isfinite(pixels).all(axis=-1)
    # next to the turning point a pixel is degrees: rounding grows to its square root
    np.testing.assert_allclose(unproject(camera, pixels[seen]), rays[seen], atol=1e-6)
    assert np.isnan(unproject(camera, pixels[~seen])).all()


def test_newtons_method_does_not_run_in_circles():
    # from this pixel plain steps within the bracket lead from 0.063 to 2.394 and back
    camera = Camera(
        model="fisheye",
        width=256,
        height=256,
        fx=100,
        fy=100,
        cx=127.5,
        cy=127.5,
        distortion=(0, 0.049, 0.047, -0.007),
    )
    ray = np.array([0.99662771, 0.03671956, 0.0733818])
    np.testing.assert_allclose(unproject(camera, project(camera, ray)), ray, atol=1e-8)


def test_pixels_beyond_the_turning_point_see_no_ray():
    camera = replace(PINHOLE, distortion=(-0.08,), fx=116, fy=116, cx=99.5, cy=99.5)
    reach = 116 * 2 / 3 * turning_radius(camera)
    assert turning_radius(camera) == pytest.approx(np.tan(np.radians(63.9)), rel=1e-3)
    rays = unproject(camera, np.array([[99.5 + 0.999 * reach, 99.5], [99.5, 99.5 - 1.001 * reach]]))
    assert np.isfinite(rays[0]).all()
    assert np.isnan(rays[1]).all()


def test_straight_behind_a_fisheye_there_is_no_pixel():
    pixels = project(FISHEYE, np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 0.0], [1e-3, 0.0, -1.0]]))
    assert np.isnan(pixels[:2]).all()


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
