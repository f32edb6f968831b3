"""Head pose: known poses are found again, as OpenCV finds them, and every writer that can carry them does."""

import csv
import io
import sys
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import LANDMARK_COUNT
from facegen.formats.live_link import ROTATIONS
from facegen.geometry import angles_from_rotation, rotation_from_angles
from regress.errors import InputError
from regress.runtime.heads import fit
from regress.runtime.heads.camera import TYPICAL_DISTANCE_M, CameraSettings, FaceCamera
from regress.runtime.heads.fit import FACING, fit_poses, own_shape
from regress.runtime.heads.shape import HeadShape, load_head_shape, shape_of_person
from regress.runtime.prediction import Prediction
from regress.runtime.sample import Sample
from regress.runtime.stages.head import HeadPose, HeadSettings, HeadSmoothing, angles_of
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.output import Mirror
from regress.runtime.writers.csv_table import HEAD_COLUMNS, weights_csv
from regress.runtime.writers.live_link import live_link_text
from tests.regress.drawn import drawn_faces

CAMERA = FaceCamera(focal_px=900.0, centre_px=(639.5, 359.5))
SHAPE = load_head_shape()


def angles(degrees: float) -> st.SearchStrategy[float]:
    return st.floats(-degrees, degrees).map(np.radians)


@st.composite
def heads(draw: st.DrawFn) -> np.ndarray:
    """Position, yaw, pitch and roll of a head that a camera sees."""
    distance = draw(st.floats(0.3, 2.0))
    beside = [draw(st.floats(-0.4, 0.4)) * distance for _ in "xy"]
    return np.array([*beside, distance, draw(angles(35)), draw(angles(30)), draw(angles(180))])


def seen(points: np.ndarray, head: np.ndarray, camera: FaceCamera = CAMERA) -> np.ndarray:
    """Points (p, 3) of a head, as `landmarks` of a face (68, 2); the others are beside them."""
    rotation = FACING @ rotation_from_angles(*head[3:])
    in_camera = points @ rotation.T + head[:3]
    face = np.zeros((LANDMARK_COUNT, 2))
    face[SHAPE.landmarks] = camera.focal_px * in_camera[:, :2] / in_camera[:, 2:] + camera.centre_px
    return face


def head_found(faces: np.ndarray, shape: HeadShape = SHAPE, camera: FaceCamera = CAMERA) -> np.ndarray:
    poses = fit_poses(faces, camera, shape)
    return np.concatenate([poses.translation, angles_of(poses.rotation)], axis=1)


@given(head=heads())
def test_a_known_pose_is_found(head: np.ndarray):
    """Of the mean face, and of a person's own; roll as it is where the picture lies on its side."""
    found = head_found(np.stack([seen(SHAPE.points, head)] * 2))
    np.testing.assert_allclose(found[0, :5], head[:5], atol=1e-5)
    assert abs(np.angle(np.exp(1j * (found[0, 5] - head[5])))) < 1e-5
    np.testing.assert_allclose(found[1], found[0], atol=1e-12)


@given(
    head=heads(),
    noise=st.integers(0, 2**32 - 1).map(
        lambda seed: np.random.default_rng(seed).normal(size=(LANDMARK_COUNT, 2))
    ),
)
def test_opencv_agrees(head: np.ndarray, noise: np.ndarray):
    """A rigid shape with equal weights is perspective-n-point, also where nothing fits exactly."""
    rigid = replace(SHAPE, modes=SHAPE.modes[:0], uncertainty_m=np.full(len(SHAPE.points), 0.001))
    size = CAMERA.focal_px / head[2] * 0.09  # between the outer corners of the eyes
    face = seen(SHAPE.points, head) + 0.01 * size * noise
    poses = fit_poses(face[None], CAMERA, rigid)
    matrix = np.array(
        [[CAMERA.focal_px, 0, CAMERA.centre_px[0]], [0, CAMERA.focal_px, CAMERA.centre_px[1]], [0, 0, 1]]
    )
    start = cv2.Rodrigues(FACING @ rotation_from_angles(*head[3:]))[0], head[:3].copy()
    _, turn, place = cv2.solvePnP(
        SHAPE.points, face[SHAPE.landmarks], matrix, None, *start, useExtrinsicGuess=True
    )
    np.testing.assert_allclose(poses.rotation[0], cv2.Rodrigues(turn)[0], atol=2e-4)
    np.testing.assert_allclose(poses.translation[0], place.ravel(), rtol=1e-3, atol=1e-4)


@given(head=heads(), seed=st.integers(0, 2**32 - 1))
def test_derivatives_are_those_of_central_differences(head: np.ndarray, seed: int):
    """Central differences of 1e-6 (radians, metres, standard deviations) leave 1e-9 of the third derivatives."""
    rng = np.random.default_rng(seed)
    poses = fit.HeadPoses(
        rotation=(FACING @ rotation_from_angles(*head[3:]))[None],
        translation=head[None, :3],
        coefficients=rng.normal(size=(1, len(SHAPE.modes))),
    )
    target, weight = rng.normal(size=(1, len(SHAPE.points), 2)), rng.uniform(1, 2, (1, len(SHAPE.points)))
    _, jacobian = fit._linearised(poses, target, weight, SHAPE)
    for column in range(jacobian.shape[2]):
        step = np.zeros((1, jacobian.shape[2]))
        step[0, column] = 1e-6
        ahead, behind = (
            fit._linearised(fit._moved(poses, sign * step), target, weight, SHAPE)[0] for sign in (1, -1)
        )
        np.testing.assert_allclose((behind - ahead) / 2e-6, jacobian[..., column], atol=1e-6)


@given(head=heads())
def test_angles_are_the_ground_s(head: np.ndarray):
    rotation = (FACING @ rotation_from_angles(*head[3:]))[None]
    np.testing.assert_allclose(
        angles_of(rotation)[0], [float(a[0]) for a in angles_from_rotation(FACING @ rotation)]
    )


def test_a_neutral_frame_shows_the_person():
    """What is unlike the mean face, and where a detector puts its points, no longer turns the head."""
    rng = np.random.default_rng(2)
    person = SHAPE.points + np.einsum("k,kpd->pd", rng.normal(size=len(SHAPE.modes)), SHAPE.modes)
    person += rng.normal(size=person.shape) * [0.002, 0.002, 0]
    turns = np.array(
        [[0.02, 0.01, 0.7, *np.radians(angle)] for angle in ((0, 0, 0), (20, 5, 3), (-25, -9, -8))]
    )
    faces = np.array([seen(person, head) for head in turns])
    own = own_shape(faces[:1], CAMERA, SHAPE)
    found = head_found(faces, own)
    assert np.degrees(np.abs(found[:, 3:] - turns[:, 3:])).max() < 4
    since, by_mean = (
        np.degrees(np.abs((heads - heads[0]) - (turns - turns[0]))[1:, 3:]).mean()
        for heads in (found, head_found(faces))
    )
    assert since < 0.75 < by_mean
    with_blink = np.concatenate(
        [faces[:1]] * 4 + [np.full_like(faces[:1], np.nan), faces[:1] + rng.normal(size=(1, 68, 2))]
    )
    for neutral in (with_blink, with_blink[::-1]):
        np.testing.assert_allclose(own_shape(neutral, CAMERA, SHAPE).points, own.points, atol=1e-9)


def test_what_is_known_of_the_camera():
    """A picture gives the middle and, at 60 degrees along its longer side, the focal length; else a face does."""
    face = seen(
        SHAPE.points,
        np.array([0, 0, TYPICAL_DISTANCE_M, 0, 0, 0.3]),
        FaceCamera(focal_px=500, centre_px=(80, 90)),
    )
    known = CameraSettings(picture_px=(640, 480)).camera(face, SHAPE)
    assert (known.focal_px, known.centre_px) == (pytest.approx(320 / np.tan(np.radians(30))), (319.5, 239.5))
    assert CameraSettings(picture_px=(640, 480), focal_px=700.0).camera(face, SHAPE).focal_px == 700
    upright = CameraSettings(picture_px=(480, 640)).camera(face, SHAPE)
    assert (upright.focal_px, upright.centre_px) == (pytest.approx(known.focal_px), (239.5, 319.5))
    across = CameraSettings(picture_px=(480, 640), fov_deg=60.0).camera(face, SHAPE)
    assert across.focal_px == pytest.approx(240 / np.tan(np.radians(30)))
    unknown = CameraSettings().camera(face, SHAPE)
    found = head_found(face[None], camera=unknown)[0]
    np.testing.assert_allclose(found[:3], [0, 0, TYPICAL_DISTANCE_M], atol=0.03)
    assert CameraSettings(focal_px=500.0).camera(face, SHAPE).focal_px == 500
    with pytest.raises(InputError, match=r"angle of view of 70 degrees needs the picture's size"):
        CameraSettings(fov_deg=70.0)


def _samples(count: int = 5) -> list[Sample]:
    turns = [np.array([0.01 * row + 0.005, 0.02, 0.6, 0.1 * row, 0.05, -0.02 * row]) for row in range(count)]
    return [
        Sample(label=str(row), time_s=row / 30, points=seen(SHAPE.points, turn), weights=np.zeros(52))
        for row, turn in enumerate(turns)
    ]


def _with_heads(samples: list[Sample]) -> list[Sample]:
    return HeadPose(HeadSettings(camera=CameraSettings(picture_px=(1280, 720), focal_px=900.0))).run(samples)


def test_faces_that_nothing_can_be_said_of():
    """A missing face has no head; one whose stiff points are in one place has none either, but keeps its weights."""
    samples = _samples()
    samples[1] = replace(samples[1], points=np.full((68, 2), np.nan), weights=np.full(52, np.nan))
    lone = samples[2].points.copy()
    lone[SHAPE.landmarks] = 7.0
    samples[2] = replace(samples[2], points=lone)
    samples[3] = replace(samples[3], points=samples[3].points * 1e14)
    answers = _with_heads(samples)
    assert [bool(np.isnan(sample.head).any()) for sample in answers] == [False, True, True, False, False]
    rows = list(csv.DictReader(io.StringIO(weights_csv(Prediction(samples=answers, source="here")))))
    assert tuple(rows[0])[-6:] == HEAD_COLUMNS
    assert {rows[1]["jawOpen"], rows[1]["head_yaw_deg"], rows[2]["head_yaw_deg"]} == {""}
    assert float(rows[2]["jawOpen"]) == 0


def test_units_and_signs_of_the_tables():
    answers = _with_heads(_samples())
    prediction = Prediction(samples=answers, source="here")
    row = list(csv.DictReader(io.StringIO(weights_csv(prediction))))[3]
    written = [float(row[name]) for name in HEAD_COLUMNS]
    np.testing.assert_allclose(written, [0.035, 0.02, 0.6, *np.degrees([0.3, 0.05, -0.06])], atol=1e-4)
    row = list(csv.DictReader(io.StringIO(live_link_text(prediction))))[3]
    np.testing.assert_allclose([float(row[name]) for name in ROTATIONS[:3]], [0.3, 0.05, 0.06], atol=1e-6)
    assert {float(row[name]) for name in ROTATIONS[3:]} == {0}


@given(
    start=st.lists(st.floats(-np.pi, np.pi), min_size=3, max_size=3),
    turn=st.lists(st.floats(-0.3, 0.3), min_size=3, max_size=3),
)
def test_smoothing_goes_on_over_half_a_turn(start: list[float], turn: list[float]):
    """As where the camera hangs upside down: smoothed angles are those of the same head elsewhere, turned there."""

    def smoothed(begin: np.ndarray) -> np.ndarray:
        angles = begin + np.outer(np.sin(np.arange(30) / 3), turn)
        wrapped = (angles + np.pi) % (2 * np.pi) - np.pi
        samples = [
            Sample(time_s=row / 30, head=np.array([0, 0, 0.6, *each])) for row, each in enumerate(wrapped)
        ]
        return np.array([sample.head[3:] for sample in HeadSmoothing(OneEuro(cutoff_hz=1.0)).run(samples)])

    found, expected = smoothed(np.array(start)), smoothed(np.zeros(3)) + start
    assert np.abs(found).max() <= np.pi + 1e-9
    np.testing.assert_allclose(np.exp(1j * found), np.exp(1j * expected), atol=1e-9)


@given(start_s=st.floats(0, 1e5))
def test_timecodes_begin_at_0_whenever_a_recording_did(start_s: float):
    def codes(begin_s: float) -> list[str]:
        samples = [Sample(time_s=begin_s + number / 30, weights=np.zeros(52)) for number in range(40)]
        text = live_link_text(Prediction(samples=samples, source="here"))
        return [row["Timecode"] for row in csv.DictReader(io.StringIO(text))]

    assert codes(start_s)[0] == "00:00:00:00.000"
    assert codes(round(start_s)) == codes(0.0)


def test_a_mirror_and_smoothing():
    answers = _with_heads(_samples())
    mirrored = Mirror().run(answers)
    np.testing.assert_allclose(mirrored[3].head, [-0.035, 0.02, 0.6, -0.3, 0.05, 0.06], atol=1e-5)
    smooth = HeadSmoothing(OneEuro(cutoff_hz=1.0)).run(answers)
    np.testing.assert_array_equal(smooth[0].head, answers[0].head)
    assert 0 < smooth[3].head[3] < answers[3].head[3]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--picture", "1280"), "is no size; WIDTHxHEIGHT in pixels is needed"),
        (("--picture", "0x720"), "is no size"),
        (("--fov-deg", 70), "needs the picture's size"),
        (("--picture", "640x480", "--fov-deg", 70, "--focal-px", 500), "give one of them"),
        (("--focal-px", 0), "greater than or equal to 1"),
    ],
)
def test_options_of_cameras_that_cannot_be_are_refused(
    options, said: str, run, quick_model_folder: Path, tmp_path: Path
):
    np.save(tmp_path / "take.npy", drawn_faces(np.random.default_rng(4), 3))
    code, out, err = run("predict", quick_model_folder, tmp_path / "take.npy", *options)
    assert (code, out) == (2, "")
    assert said in " ".join(err.replace("│", " ").split())


@pytest.mark.parametrize(
    "options",
    [
        ("--head", "--filter", "kalman-33"),
        ("--picture", "1280x720", "--filter", "kalman-33"),
        ("--focal-px", "900", "--one-euro", "1"),
    ],
)
def test_a_pipe_gives_what_the_file_gives(options, run, quick_model_folder: Path, tmp_path, monkeypatch):
    faces = np.array([sample.points for sample in _samples()])
    faces[:, 48:68] = faces[:, 30:31] + np.random.default_rng(3).normal(size=(5, 20, 2)) * 20 + [0, 60]
    faces[3] = np.nan
    np.save(tmp_path / "take.npy", faces)
    code, out, err = run("predict", quick_model_folder, tmp_path / "take.npy", "--fps", 25, *options)
    assert code == 0, err
    lines = [" ".join(map(repr, face.ravel().tolist())) for face in faces]
    monkeypatch.setattr(sys, "stdin", io.StringIO("\n".join(lines) + "\n"))
    code, piped, err = run("predict", quick_model_folder, "-", "--fps", 25, *options)
    assert code == 0, err
    rows, streamed = (list(csv.DictReader(io.StringIO(text))) for text in (out, piped))
    assert [list(row.values())[1:] for row in rows] == [list(row.values())[1:] for row in streamed]
    assert [row["head_yaw_deg"] == "" for row in rows] == [False, False, False, True, False]


def test_a_person_s_shape_has_expressions_alone():
    own = shape_of_person(SHAPE.points)
    assert len(own.modes) < len(SHAPE.modes)
    assert np.linalg.norm(own.modes) < np.linalg.norm(SHAPE.modes)


def test_a_neutral_take_without_a_whole_face_is_refused():
    faces = drawn_faces(np.random.default_rng(3), 2)
    faces[:, 5] = np.nan
    with pytest.raises(InputError, match="no face of the neutral frames is whole"):
        HeadPose(HeadSettings(neutral=faces))
