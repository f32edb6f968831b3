"""A face depends on its own row alone, and blendshapes move what they should."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES, MIRRORED_LANDMARKS
from facegen.errors import InputError
from facegen.rigs import Rig, evaluate, occluder
from tests.facegen.rigs.people import people, straight, weights


def random_faces(rig: Rig, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.Generator(np.random.PCG64(11))
    return (
        rng.standard_normal((count, rig.components)),
        rng.random((count, len(BLENDSHAPES))),
        straight(count),
    )


@given(start=st.integers(0, 239), count=st.integers(1, 130))
@settings(max_examples=8, deadline=None)
def test_row_does_not_depend_on_others(anny: Rig, start: int, count: int) -> None:
    faces = random_faces(anny, 240)
    rows = slice(start, start + count)
    whole = evaluate(anny, *faces, cage_only=True)
    some = evaluate(anny, *(array[rows] for array in faces), cage_only=True)
    for name, values in vars(some).items():
        np.testing.assert_array_equal(values, getattr(whole, name)[rows])


def test_cage_is_the_same_alone(rig: Rig) -> None:
    faces = random_faces(rig, 3)
    whole, cage = evaluate(rig, *faces), evaluate(rig, *faces, cage_only=True)
    assert whole.vertices.shape[1] == len(rig.vertices)
    np.testing.assert_array_equal(cage.vertices, whole.vertices[:, occluder(rig).vertices])
    np.testing.assert_array_equal(cage.landmarks, whole.landmarks)


def test_eyes_stay_about_the_origin_and_in_the_lids(rig: Rig) -> None:
    identity, weights, gaze = random_faces(rig, 50)
    centre = evaluate(rig, identity, weights, gaze, cage_only=True).eye_center
    middle = centre.mean(axis=1)
    np.testing.assert_allclose(middle[:, 0], 0.0, atol=1e-8)  # float32 on disk
    np.testing.assert_array_less(np.abs(middle[:, 1]), 6e-3)
    # human eyes stand before the large ones that sources centre there
    np.testing.assert_array_less(np.abs(middle[:, 2] - 5e-3), 4.5e-3)
    assert (centre[:, 0, 0] > 0.02).all()


def test_mean_landmarks_are_mirror_symmetric(rig: Rig) -> None:
    landmarks = evaluate(rig, people(rig, 1), weights(1), straight(1), cage_only=True).landmarks[0]
    mirrored = landmarks[list(MIRRORED_LANDMARKS)] * (-1.0, 1.0, 1.0)
    # anny's population is asymmetric person by person: its mean is off by a tenth of a millimetre or so
    assert np.linalg.norm(landmarks - mirrored, axis=1).max() < 0.6e-3


def test_landmarks_lie_where_their_names_say(rig: Rig) -> None:
    points = evaluate(rig, people(rig, 1), weights(1), straight(1), cage_only=True).landmarks[0]
    assert points[0, 0] < -0.05
    assert points[16, 0] > 0.05
    assert points[30, 2] > points[8, 2] > points[0, 2]
    assert (
        points[19, 1]
        > points[37, 1]
        > points[41, 1]
        > points[33, 1]
        > points[51, 1]
        > points[57, 1]
        > points[8, 1]
    )
    assert 0.075 < np.linalg.norm(points[45] - points[36]) < 0.100


@pytest.mark.parametrize(
    ("shape", "share"),
    [
        ("jawOpen", 0.444),
        ("mouthClose", 0.289),
        ("mouthSmileLeft", 0.142),
        ("mouthRight", 0.143),
        ("eyeBlinkLeft", 0.105),
        ("eyeLookDownRight", 0.048),
        ("noseSneerLeft", 0.039),
        ("browInnerUp", 0.136),
    ],
)
def test_weight_one_means_about_what_apple_means(rig: Rig, shape: str, share: float) -> None:
    rows = np.concatenate([weights(1), weights(1, **{shape: 1.0})])
    points = evaluate(rig, people(rig, 1).repeat(2, 0), rows, straight(2), cage_only=True).landmarks[..., :2]
    moved = np.linalg.norm(points[1] - points[0], axis=-1).max()
    width = np.linalg.norm(points[0, 45] - points[0, 36])
    assert 0.75 * share < moved / width < 1.25 * share


def test_lips_meet_and_do_not_pass_each_other(rig: Rig) -> None:
    shapes = ({}, {"mouthRollUpper": 1.0, "mouthRollLower": 1.0}, {"jawOpen": 0.4, "mouthClose": 0.46})
    rows = np.concatenate([weights(10, **shape) for shape in shapes] + [random_faces(rig, 60)[1]])
    vertices = evaluate(rig, people(rig, 90), rows, straight(90), cage_only=True)
    points = vertices.landmarks
    unclamped = np.einsum("ln,blnc->blc", rig.landmark_weights, vertices.vertices[:, rig.landmark_vertices])
    upper, lower = [61, 62, 63], [67, 66, 65]
    gap = unclamped[:, upper, 1] - unclamped[:, lower, 1]
    assert (gap < -1e-3).any()  # the shapes do press lips through each other
    np.testing.assert_allclose(points[:, upper, 1] - points[:, lower, 1], np.maximum(gap, 0.0), atol=1e-12)
    np.testing.assert_allclose(
        points[:, upper, 1] + points[:, lower, 1], unclamped[:, upper, 1] + unclamped[:, lower, 1], atol=1e-12
    )


def test_jaw_open_moves_the_chin_down(rig: Rig) -> None:
    rows = np.concatenate([weights(1), weights(1, jawOpen=0.5), weights(1, jawOpen=1.0)])
    chin = evaluate(rig, people(rig, 1).repeat(3, 0), rows, straight(3), cage_only=True).landmarks[:, 8, 1]
    assert chin[0] - chin[2] > 0.02
    np.testing.assert_allclose(chin[0] - chin[1], chin[1] - chin[2], rtol=1e-6)


@pytest.mark.parametrize("field", [0, 1, 2])
def test_wrong_input_is_refused(anny: Rig, field: int) -> None:
    faces = list(random_faces(anny, 2))
    faces[field] = np.full_like(faces[field], np.nan)
    with pytest.raises(InputError, match="finite"):
        evaluate(anny, *faces)
    faces[field] = np.zeros((2, 7))
    with pytest.raises(InputError, match="shape"):
        evaluate(anny, *faces)


def test_no_faces_give_no_faces(anny: Rig) -> None:
    assert evaluate(anny, *random_faces(anny, 0), cage_only=True).landmarks.shape == (0, 68, 3)
