"""Frames of heads and eyes: rotations stay rotations, and a nod is a nod in each of them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.geometry import direction_from_angles, rotation_from_angles
from regress.runtime.heads.fit import FACING
from regress.runtime.sample import Sample
from regress.runtime.stages.head import angles_of
from regress.runtime.stages.output import Mirror
from track.sinks.axes import (
    eye_turns,
    head_pose,
    quaternion,
    share_of,
    unity_euler_deg,
    unity_position,
    unity_quaternion,
)

ANGLES = st.tuples(*[st.floats(-1.5, 1.5)] * 3)
METRES = st.tuples(*[st.floats(-2, 2)] * 3)
MIRROR_X = np.diag([-1.0, 1.0, 1.0])


def matrix(rotation: np.ndarray) -> np.ndarray:
    """Of a unit quaternion x, y, z, w: columns are where the axes go."""
    x, y, z, w = rotation
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def unity_euler_matrix(degrees: np.ndarray) -> np.ndarray:
    """As Unity's manual has it: about z, then x, then y, each by the same formulas as in a right-handed frame."""
    (cx, cy, cz), (sx, sy, sz) = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return about_y @ about_x @ about_z


@given(angles=ANGLES)
def test_a_turn_is_a_right_handed_rotation_and_the_one_of_geometry(angles):
    turn = quaternion(*angles)
    assert np.linalg.norm(turn) == pytest.approx(1)
    np.testing.assert_allclose(matrix(turn), rotation_from_angles(*angles), atol=1e-12)
    assert np.linalg.det(matrix(turn)) == pytest.approx(1)


@given(angles=ANGLES, position=METRES)
def test_a_head_is_where_and_turned_as_the_camera_saw_it(angles, position):
    pose = head_pose(np.array([*position, *angles]))
    camera_from_head = FACING @ rotation_from_angles(*angles)
    np.testing.assert_allclose(angles_of(camera_from_head[None])[0], angles, atol=1e-9)  # so Sample has it
    np.testing.assert_allclose(FACING @ pose.position, position, atol=1e-12)
    np.testing.assert_allclose(FACING @ matrix(pose.rotation), camera_from_head, atol=1e-9)


@given(angles=ANGLES, position=METRES)
def test_unity_sees_the_same_head_in_a_mirrored_frame(angles, position):
    turn = quaternion(*angles)
    expected = MIRROR_X @ matrix(turn) @ MIRROR_X
    np.testing.assert_allclose(matrix(unity_quaternion(turn)), expected, atol=1e-12)
    np.testing.assert_allclose(unity_euler_matrix(unity_euler_deg(np.array(angles))), expected, atol=1e-12)
    np.testing.assert_allclose(unity_position(np.array(position)), MIRROR_X @ position)


@given(angles=ANGLES, share=st.floats(0, 1))
def test_shares_of_a_turn_make_the_turn(angles, share):
    turn = quaternion(*angles)
    one, rest = (matrix(share_of(turn, part)) for part in (share, 1 - share))
    np.testing.assert_allclose(one @ rest, matrix(turn), atol=1e-9)
    np.testing.assert_allclose(
        share_of(-turn, share), share_of(turn, share), atol=1e-12
    )  # both say the same turn
    half = matrix(share_of(turn, 0.5))
    np.testing.assert_allclose(half @ half, matrix(turn), atol=1e-9)
    assert np.trace(half) >= 1 - 1e-9  # by 90 degrees at most: the short way


@given(angles=ANGLES, position=METRES)
def test_going_to_unity_twice_comes_back(angles, position):
    turn = quaternion(*angles)
    np.testing.assert_array_equal(unity_quaternion(unity_quaternion(turn)), turn)
    np.testing.assert_array_equal(unity_position(unity_position(np.array(position))), position)


@pytest.mark.parametrize(
    ("moves", "gltf", "unity"),
    [
        (
            "yaw",
            (0.5, 0, 0.75**0.5),
            (-0.5, 0, 0.75**0.5),
        ),  # 30 degrees to the subject's left: +x, Unity's -x
        ("pitch", (0, 0.5, 0.75**0.5), (0, 0.5, 0.75**0.5)),  # 30 degrees up
    ],
)
def test_where_a_nose_points(moves, gltf, unity):
    head = np.zeros(6)
    head[{"yaw": 3, "pitch": 4}[moves]] = np.pi / 6
    turn = head_pose(head).rotation
    np.testing.assert_allclose(matrix(turn)[:, 2], gltf, atol=1e-12)
    np.testing.assert_allclose(matrix(unity_quaternion(turn))[:, 2], unity, atol=1e-12)
    np.testing.assert_allclose(unity_euler_matrix(unity_euler_deg(head[3:]))[:, 2], unity, atol=1e-12)


def test_where_the_top_of_a_head_goes_that_tilts_to_its_left_shoulder():
    turn = head_pose(np.array([0, 0, 0, 0, 0, np.pi / 6])).rotation
    np.testing.assert_allclose(matrix(turn)[:, 1], (0.5, 0.75**0.5, 0), atol=1e-12)
    np.testing.assert_allclose(matrix(unity_quaternion(turn))[:, 1], (-0.5, 0.75**0.5, 0), atol=1e-12)


@given(gaze=st.tuples(*[st.floats(-1, 1)] * 4))
def test_eyes_look_where_the_gaze_goes(gaze):
    for turn, (yaw, pitch) in zip(eye_turns(np.array(gaze)), np.reshape(gaze, (2, 2)), strict=True):
        np.testing.assert_allclose(matrix(turn)[:, 2], direction_from_angles(yaw, pitch), atol=1e-12)


@given(angles=ANGLES, position=METRES)
def test_a_mirrored_head_is_the_head_in_a_mirror(angles, position):
    sample = Mirror().step(Sample(weights=np.zeros(52), head=np.array([*position, *angles])))
    mirrored, pose = head_pose(sample.head), head_pose(np.array([*position, *angles]))
    np.testing.assert_allclose(mirrored.position, MIRROR_X @ pose.position)
    np.testing.assert_allclose(
        matrix(mirrored.rotation), MIRROR_X @ matrix(pose.rotation) @ MIRROR_X, atol=1e-12
    )


def test_what_is_not_known_is_none():
    assert head_pose(None) is None
    assert head_pose(np.full(6, np.nan)) is None
    assert eye_turns(None) is None
    assert eye_turns(np.array([0, 0, np.nan, 0])) is None
