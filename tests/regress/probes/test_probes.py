"""Probes: on methods whose errors are known, they find just these."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPE_INDEX
from regress.learning.probes import ProbeFaces
from regress.learning.probes.crosstalk import WEIGHT, cross_talk, moved_with
from regress.learning.probes.faces import frontal
from regress.learning.probes.methods import Method
from regress.learning.probes.movements import movements
from regress.learning.probes.observability import NOISE_PERCENT, observability
from regress.learning.probes.people import person_errors
from regress.learning.probes.poses import PITCH_DEG, WITHIN_DEG, YAW_DEG, PoseErrors, pose_errors
from regress.learning.probes.stillness import JITTER_PERCENT, stillness
from regress.learning.probes.winks import winks
from regress.learning.training.noise import OUTER_EYES
from regress.learning.training.preparation import OUTPUT_COLUMNS
from regress.targets import OUTPUTS, VISIBLE_SHAPES
from tests.regress.drawn import drawn_heads


@pytest.fixture(scope="module")
def everyone() -> ProbeFaces:
    dataset, columns = drawn_heads(np.random.default_rng(2), people=40)
    return ProbeFaces(
        points_px=columns["points_2d"],
        points_m=columns["points_3d"],
        camera_from_head=columns["camera_from_head"],
        intrinsics=columns["intrinsics"],
        weights=dataset.weights,
        person=dataset.person,
        neutral=dataset.neutral,
        split=dataset.split,
    )


@pytest.fixture(scope="module")
def held_out(everyone) -> tuple[ProbeFaces, ProbeFaces]:
    return everyone.beside_neutral("test")


def method(predict, *, calibrated: bool = True) -> Method:
    return Method(name="known", calibrated=calibrated, predict=predict)


def outputs(faces: ProbeFaces) -> np.ndarray:
    return faces.weights[:, OUTPUT_COLUMNS]


def test_faces_stand_beside_their_own_neutral_ones(everyone):
    faces, neutral = everyone.beside_neutral("test")
    assert not faces.neutral.any()
    assert neutral.neutral.all()
    np.testing.assert_array_equal(faces.person, neutral.person)
    assert set(faces.split) == {"test"}
    assert len(faces.person) == np.sum((everyone.split == "test") & ~everyone.neutral)


def test_a_face_turned_to_its_own_pose_is_the_picture_itself(everyone):
    yaw, pitch = everyone.pose_deg
    for row in range(10):
        one = everyone.take(np.array([row]))
        turned = one.turned(yaw_deg=yaw[row], pitch_deg=pitch[row])
        np.testing.assert_allclose(turned, one.points_px, atol=1e-9)


@settings(max_examples=25, deadline=None)
@given(yaw=st.floats(-60, 60), pitch=st.floats(-60, 60))
def test_a_positive_yaw_turns_to_the_subjects_left_and_a_positive_pitch_upwards(everyone, yaw, pitch):
    # the nose's tip lies before the eyes' line: it moves as the head looks, right and up in the picture
    tip = np.array([[[0.0, 0.0, 0.1]]])
    one = replace(everyone.take(np.array([0])), points_m=tip)
    x, y = one.turned(yaw_deg=yaw, pitch_deg=pitch)[0, 0] - [320, 240]
    assert np.sign(np.round(x, 9)) == np.sign(np.round(np.sin(np.radians(yaw)), 12)) or abs(yaw) < 1e-6
    assert np.sign(np.round(y, 9)) == -np.sign(np.round(np.sin(np.radians(pitch)), 12)) or abs(pitch) < 1e-6


def test_movements_are_those_that_made_the_faces(everyone, held_out):
    found = movements(*everyone.beside_neutral("train"))
    assert found.residual_m < 1e-12
    faces, neutral = held_out
    never = BLENDSHAPE_INDEX["browInnerUp"]  # the drawn faces do not move it: nothing is known of it
    assert np.abs(found.per_weight_m[never]).max() < 1e-15
    for row in range(5):
        weights = dict(zip(BLENDSHAPE_INDEX, faces.weights[row], strict=True))
        moved = found.moved(neutral.take(np.array([row])), **weights)
        np.testing.assert_allclose(moved[0], faces.points_m[row], atol=1e-12)


def test_a_known_mixture_of_outputs_is_the_leak_that_is_found(everyone, held_out):
    moves = movements(*everyone.beside_neutral("train"))
    _, first = np.unique(held_out[1].person, return_index=True)
    neutral = held_out[1].take(first)
    # far away a face's picture is linear in its weights, so least squares reads them exactly
    neutral = replace(neutral, camera_from_head=neutral.camera_from_head * 1.0)
    neutral.camera_from_head[:, 2, 3] = 1000.0
    scale = 600 / 1000.0
    shifts = (moves.per_weight_m[OUTPUT_COLUMNS][..., :2] * [1, -1] * scale).reshape(len(OUTPUTS), -1)
    mixture = np.eye(len(OUTPUTS))
    jaw, smile = OUTPUTS.index("jawOpen"), OUTPUTS.index("mouthSmileLeft")
    left, right = OUTPUTS.index("eyeBlinkLeft"), OUTPUTS.index("eyeBlinkRight")
    mixture[jaw, smile], mixture[left, right], mixture[right, left] = -0.3, 0.1, 0.2

    close = OUTPUTS.index("mouthClose")

    def read(points, beside):
        weights = (points - beside).reshape(len(points), -1) @ np.linalg.pinv(shifts)
        weights[:, close] *= weights[:, jaw] > 0.5  # lips are known to close over an open jaw only
        return 0.05 + weights @ mixture  # said of a neutral face as well: no leak

    talk = cross_talk(method(read), neutral, moves)
    for row, name in enumerate(OUTPUTS):
        if name != "browInnerUp":
            together = [OUTPUTS.index(other) for other in moved_with(name)]
            np.testing.assert_allclose(
                talk.change[row], WEIGHT * mixture[together].sum(axis=0), atol=2e-3, err_msg=name
            )
    assert talk.largest(1)[0] == ("jawOpen", "mouthSmileLeft", pytest.approx(-0.3 * WEIGHT, abs=2e-3))


def test_a_wink_shuts_one_eye_and_leaves_the_face_neutral(held_out):
    faces, neutral = held_out
    blinks = [BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]]
    faces = replace(faces, weights=faces.weights.copy())
    faces.weights[:, blinks] = 0.0
    faces.weights[:5, blinks] = [0.95, 1.0]
    asked = []

    def read(points, beside):
        asked.append((points, beside))
        said = np.zeros((len(points), len(OUTPUTS)))
        for name, lids in (("eyeBlinkLeft", slice(42, 48)), ("eyeBlinkRight", slice(36, 42))):
            moved = (points[:, lids] != beside[:, lids]).any(axis=(1, 2))
            said[:, OUTPUTS.index(name)] = np.where(moved, 0.7, 0.1)
        said[:, [OUTPUTS.index("eyeBlinkLeft"), OUTPUTS.index("eyeBlinkRight")]] += (
            0.2 * (points[:, 36:48] != beside[:, 36:48]).any(axis=2).all(axis=1)[:, None]
        )  # both
        return said

    found = winks(method(read), faces, neutral)
    assert found.count == 5
    assert found.true == pytest.approx(0.975)
    assert (found.shut, found.leak, found.both) == pytest.approx((0.7, 0.1, 0.9))
    shut = frontal(faces.points_m, neutral)[:5]
    for (points, beside), lids in zip(asked, (range(36, 48), range(42, 48), range(36, 42)), strict=True):
        np.testing.assert_allclose(points[:, list(lids)], shut[:, list(lids)], atol=1e-9)
        rest = np.setdiff1d(np.arange(68), lids)
        np.testing.assert_array_equal(points[:, rest], beside[:, rest])


def test_gaze_moves_both_eyes_the_same_way():
    assert moved_with("eyeLookInLeft") == ("eyeLookInLeft", "eyeLookOutRight")
    assert moved_with("eyeLookDownRight") == ("eyeLookDownRight", "eyeLookDownLeft")
    assert moved_with("eyeBlinkLeft") == ("eyeBlinkLeft",)
    assert all(set(moved_with(name)) <= set(OUTPUTS) for name in OUTPUTS)


def test_loss_counts_poses_within_the_bound_and_not_the_frontal_one():
    shape = (len(PITCH_DEG), len(YAW_DEG), 1)
    pitch, yaw = np.meshgrid(PITCH_DEG, YAW_DEG, indexing="ij")
    within = (np.maximum(np.abs(pitch), np.abs(yaw)) <= WITHIN_DEG)[..., None]
    frontal_pose = ((pitch == 0) & (yaw == 0))[..., None]
    mse = np.where(frontal_pose, 0.1, np.where(within, 0.3, 7.0)).reshape(shape)
    errors = PoseErrors(method="known", calibrated=False, mae=mse * 2, mse=mse, variance=np.array([1.0]))
    assert errors.frontal_r2[0] == pytest.approx(0.9)
    assert errors.turned_r2[0] == pytest.approx(0.7)
    assert errors.loss[0] == pytest.approx(0.2)
    assert errors.mae_rise[0] == pytest.approx(0.4)
    still = replace(errors, variance=np.array([0.0]))
    assert np.isnan(still.loss[0])


def test_each_pose_has_its_own_error(held_out):
    """A method that says how far the nose's tip stands right of its root errs by yaw alone."""
    faces, neutral = held_out

    def read(points, beside):
        across = points[:, 30, 0] - points[:, 27, 0]
        frontal_across = beside[:, 30, 0] - beside[:, 27, 0]
        return outputs(faces) + 0.01 * (across - frontal_across)[:, None]

    neutral = replace(neutral, points_m=faces.points_m, camera_from_head=faces.camera_from_head)
    (errors,) = pose_errors([method(read)], faces, neutral)
    by_yaw = errors.mae[PITCH_DEG.index(0.0), :, 0]
    assert by_yaw[YAW_DEG.index(0.0)] == pytest.approx(0, abs=1e-12)
    right = by_yaw[YAW_DEG.index(0.0) :]
    assert (np.diff(right) > 0).all()
    assert errors.loss[OUTPUTS.index("jawOpen")] > 0


def test_noise_has_the_size_that_the_level_says(held_out):
    faces, neutral = held_out
    sizes = []

    def read(points, beside):
        outer = np.linalg.norm(faces.points_px[:, OUTER_EYES[0]] - faces.points_px[:, OUTER_EYES[1]], axis=1)
        moved = (points - faces.points_px) / outer[:, None, None]
        beside_moved = beside - neutral.points_px
        sizes.append((moved.std(), bool(beside_moved.any())))
        return outputs(faces)

    (found,) = observability([method(read)], faces, neutral)
    np.testing.assert_allclose([100 * size for size, _ in sizes], NOISE_PERCENT, rtol=0.03)
    assert [moved for _, moved in sizes] == [level > 0 for level in NOISE_PERCENT]
    moves = outputs(faces).var(axis=0) > 0
    assert (found.r2[:, moves] == 1).all()
    assert np.isnan(found.r2[:, ~moves]).all()


def test_the_person_with_the_largest_error_comes_first(held_out):
    faces, neutral = held_out
    chosen = faces.person[7]
    smile = OUTPUTS.index("mouthSmileRight")

    def read(points, beside):
        predicted = outputs(faces).copy()
        predicted[faces.person == chosen, smile] += 0.6
        predicted[0, OUTPUTS.index("cheekPuff")] += 5.0  # no visible shape: of no account
        return predicted

    found = person_errors(method(read), faces, neutral)
    assert found.person[0] == chosen
    assert found.mae[0] == pytest.approx(0.6 / len(VISIBLE_SHAPES))
    assert found.mae[1:].max() == 0
    worst = found.worst[0]
    assert worst.person == chosen
    name, true, predicted = worst.shapes[0]
    assert name == "mouthSmileRight"
    assert predicted - true == pytest.approx(0.6)
    people = [face.person for face in found.worst]
    assert len(people) == len(set(people))


def test_jitter_is_the_spread_over_frames_and_neutral_bias_the_mean(held_out):
    faces, neutral = held_out
    _, first = np.unique(neutral.person, return_index=True)

    def read(points, beside):
        outer = np.linalg.norm(points[:, OUTER_EYES[0]] - points[:, OUTER_EYES[1]], axis=1)
        said = np.full((len(points), len(OUTPUTS)), 0.25)
        said[:, 0] = points[:, 30, 0] / outer.mean()
        return said

    found = stillness(method(read, calibrated=False), faces, neutral, neutral.take(first))
    assert found.neutral_mean[1:] == pytest.approx(0.25)
    assert (found.jitter[:, 1:] == 0).all()
    np.testing.assert_allclose(100 * found.jitter[:, 0], JITTER_PERCENT, rtol=0.15)


def test_frontal_faces_look_into_the_camera(everyone):
    one = everyone.take(np.array([3]))
    np.testing.assert_array_equal(frontal(one.points_m, one), one.turned(yaw_deg=0, pitch_deg=0))
