"""Gaze: known eyes are found from their irises, drive the eyeLook shapes; guesses from the lids know their limits."""

import csv
import io
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, LANDMARK_COUNT
from facegen.geometry import direction_from_angles, rotation_from_angles
from facegen.rigs import Rig
from facegen.rigs.eyes import eye_geometry
from facegen.sampling.gaze import axes_from_weights, weights_from_axes
from regress.errors import InputError
from regress.runtime.features.reference_shape import load_reference_shape
from regress.runtime.heads.camera import CameraSettings, FaceCamera
from regress.runtime.heads.eyes import CORNERS, MEAN_EYES, REACH_M, gaze_angles, own_eyes
from regress.runtime.heads.fit import FACING, HeadPoses
from regress.runtime.inputs import read_frames, read_lines
from regress.runtime.model import Model
from regress.runtime.predict import landmark_chain
from regress.runtime.sample import Sample
from regress.runtime.stages.filters import FILTERS
from regress.runtime.stages.gaze import LOOKS, Looks, gaze_of, look_weights, yaw_of
from regress.runtime.stages.head import HeadPose, HeadSettings
from regress.runtime.stages.output import Output
from regress.runtime.writers.csv_table import csv_lines
from tests.facegen.formats.test_gltf_eyes import compressed

MEAN = load_reference_shape().points
CAMERA = FaceCamera(focal_px=900.0, centre_px=(639.5, 359.5))
PICTURE = CameraSettings(picture_px=(1280, 720), focal_px=900.0)


def within(degrees: float) -> st.SearchStrategy[float]:
    return st.floats(-degrees, degrees).map(np.radians)


HEADS = st.tuples(within(30), within(20), within(40)).map(np.array)
GAZES = st.tuples(within(30), within(25), within(30), within(25)).map(np.array)


def seen(
    head_rad: np.ndarray,
    gaze: np.ndarray,
    *,
    beside_m: float = 0.0,
    place: tuple[float, float, float] = (0.0, 0.0, 0.6),
    camera: FaceCamera = CAMERA,
) -> tuple[np.ndarray, np.ndarray, HeadPoses]:
    """A face (68, 2), its irises (2, 2), and its pose; eyeballs lie up to ``beside_m`` beside the mean face's."""
    rotation = FACING @ rotation_from_angles(*head_rad)
    translation = np.array(place)
    middle = MEAN[np.array(CORNERS)].mean(axis=1)
    axes = direction_from_angles(gaze[[0, 2]], gaze[[1, 3]])
    irises = middle + MEAN_EYES.ball_m + [beside_m, -beside_m, 0] + REACH_M * axes

    def picture(there: np.ndarray) -> np.ndarray:
        in_camera = there @ rotation.T + translation
        return camera.focal_px * in_camera[:, :2] / in_camera[:, 2:] + camera.centre_px

    pose = HeadPoses(rotation=rotation[None], translation=translation[None], coefficients=np.zeros((1, 0)))
    return picture(MEAN), picture(irises), pose


@given(head=HEADS, gaze=GAZES)
def test_a_known_gaze_is_found(head: np.ndarray, gaze: np.ndarray):
    """To a degree or two: an eye's corners are taken for as far away as each other."""
    face, irises, pose = seen(head, gaze, place=(0.05, -0.03, 0.6))
    found = gaze_angles(face[None], irises[None], pose, CAMERA, MEAN_EYES).ravel()
    np.testing.assert_allclose(np.degrees(found), np.degrees(gaze), atol=2.5)


def test_the_mean_eye_lies_in_the_mean_faces_lids(anny: Rig):
    """As the rig has it, to a quarter of a millimetre: one more is 5.5 degrees of gaze."""
    points = (anny.landmark_weights[..., None] * anny.vertices[anny.landmark_vertices]).sum(axis=1)
    middle = anny.eye_center - points[np.array(CORNERS)].mean(axis=1)
    np.testing.assert_allclose(MEAN_EYES.ball_m, middle, atol=2.5e-4)


def test_irises_turn_as_far_before_an_eye_s_centre_as_the_rigs_do(anny: Rig):
    geometry = eye_geometry(anny.eye_center[0], 12.0e-3, np.array([0.0, 0.0, 1.0]))
    assert pytest.approx(geometry.limbus_offset, abs=1e-6) == REACH_M


@given(gaze=GAZES)
def test_weights_are_what_facegen_makes_of_a_gaze_and_back(gaze: np.ndarray):
    weights = np.zeros(len(BLENDSHAPES))
    weights[LOOKS] = look_weights(gaze)
    axes = direction_from_angles(gaze[None, [0, 2]], gaze[None, [1, 3]])
    theirs = weights_from_axes(axes)
    assert sorted(theirs) == sorted(LOOKS)
    np.testing.assert_allclose(weights[LOOKS], [theirs[index][0] for index in LOOKS], atol=1e-9)
    np.testing.assert_allclose(gaze_of(weights), gaze, atol=1e-9)
    np.testing.assert_allclose(axes_from_weights(weights[None]), axes, atol=1e-9)


@given(gaze=GAZES, head=HEADS)
def test_neutral_irises_show_where_a_person_s_eyes_lie(gaze: np.ndarray, head: np.ndarray):
    face, irises, pose = seen(np.zeros(3), np.zeros(4), beside_m=0.001)
    eyes = own_eyes(face[None], irises[None], pose, CAMERA)
    np.testing.assert_allclose(eyes.ball_m - MEAN_EYES.ball_m, [[0.001, -0.001, 0]] * 2, atol=5e-5)
    face, irises, pose = seen(head, gaze, beside_m=0.001, place=(0.05, -0.03, 0.6))
    found = gaze_angles(face[None], irises[None], pose, CAMERA, eyes).ravel()
    np.testing.assert_allclose(np.degrees(found), np.degrees(gaze), atol=3.0)


def into_camera(head_rad: np.ndarray, place: tuple[float, float, float]) -> np.ndarray:
    """Gaze (4,) in the head frame of eyes that look into the camera, from a head that is turned like this."""
    balls = MEAN[np.array(CORNERS)].mean(axis=1) + MEAN_EYES.ball_m
    towards = -np.array(place) @ FACING @ rotation_from_angles(*head_rad) - balls
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    return np.stack([np.arctan2(towards[:, 0], towards[:, 2]), np.arcsin(towards[:, 1])], axis=1).ravel()


PLACES = st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1), st.floats(0.4, 1.0))


@given(neutral_head=HEADS.map(lambda head: head / 2), place=PLACES, gaze=GAZES)
def test_neutral_irises_that_look_into_the_camera_show_it_from_any_head(
    neutral_head: np.ndarray, place: tuple[float, float, float], gaze: np.ndarray
):
    """A head that is held down before a screen has eyes that look up, and later not all looks go down."""
    looks = into_camera(neutral_head, place)
    face, irises, pose = seen(neutral_head, looks, beside_m=0.001, place=place)
    eyes = own_eyes(face[None], irises[None], pose, CAMERA, into_camera=True)
    face, irises, pose = seen(np.zeros(3), gaze, beside_m=0.001)
    found = gaze_angles(face[None], irises[None], pose, CAMERA, eyes).ravel()
    np.testing.assert_allclose(np.degrees(found), np.degrees(gaze), atol=3.0)


def shut(face: np.ndarray, *eyes: int) -> np.ndarray:
    """A face whose lids meet, of the eyes whose first landmark is given."""
    face = face.copy()
    for eye in eyes:
        for top, low in ((eye + 1, eye + 5), (eye + 2, eye + 4)):
            face[top] = face[low] = (face[top] + face[low]) / 2
    return face


def test_a_shut_eye_goes_with_the_other_and_both_rest():
    gaze = np.radians([20.0, 10.0, 20.0, 10.0])
    face, irises, pose = seen(np.zeros(3), gaze)
    irises[1] += 9.0  # what a detector makes up behind the right eye's lids
    one = gaze_angles(shut(face, 36)[None], irises[None], pose, CAMERA, MEAN_EYES).ravel()
    np.testing.assert_allclose(np.degrees(one), np.degrees(gaze), atol=1.0)
    both = gaze_angles(shut(face, 36, 42)[None], irises[None], pose, CAMERA, MEAN_EYES)
    np.testing.assert_array_equal(both, 0)


@given(st.floats(0, 1), st.floats(-0.4, 0.4), st.floats(-0.4, 0.4))
def test_eyes_that_close_go_where_they_look_straight_ahead(closed: float, yaw: float, pitch: float):
    """Somebody who looks below the camera reads so; with that taken off, a blink looks nowhere else."""
    ahead = np.array([yaw, pitch, yaw, pitch])
    face, irises, pose = seen(np.zeros(3), ahead)
    eyes = replace(MEAN_EYES, ahead=ahead.reshape(2, 2))
    lids = face + closed * (shut(face, 36, 42) - face)
    found = gaze_angles(lids[None], irises[None], pose, CAMERA, eyes).ravel()
    np.testing.assert_allclose(np.degrees(found), np.degrees(ahead), atol=1.0)


def _sample(
    head_deg: float, weights: dict[str, float], *, irises: bool = False, gaze_deg: float = 0
) -> Sample:
    face, eyes, _ = seen(np.radians([head_deg, 0, 0]), np.radians([gaze_deg, 0, gaze_deg, 0]))
    values = np.zeros(len(BLENDSHAPES))
    for name, weight in weights.items():
        values[BLENDSHAPE_INDEX[name]] = weight
    sample = Sample(points=face, irises=eyes if irises else None, weights=values, confidence=np.full(52, 0.8))
    return HeadPose(HeadSettings(camera=PICTURE, wanted=False)).step(sample)


GUESS = {"eyeLookOutLeft": 0.4, "eyeLookInRight": 0.4, "jawOpen": 0.5}


@pytest.mark.parametrize(("head_deg", "share"), [(0, 1), (12, 1), (-20, 0.5), (20, 0.5), (30, 0), (-40, 0)])
def test_a_guess_fades_with_a_turn(head_deg: float, share: float):
    answer = Looks(fade=True).step(_sample(head_deg, GUESS))
    assert answer.weights[BLENDSHAPE_INDEX["eyeLookOutLeft"]] == pytest.approx(0.4 * share, abs=0.08)
    assert answer.weights[BLENDSHAPE_INDEX["jawOpen"]] == 0.5
    assert answer.confidence[LOOKS[0]] == pytest.approx(0.8 * share, abs=0.16)
    assert answer.confidence[BLENDSHAPE_INDEX["jawOpen"]] == 0.8
    assert answer.gaze is answer.head is None
    kept = Looks(fade=False).step(_sample(head_deg, GUESS))
    assert kept.weights[BLENDSHAPE_INDEX["eyeLookOutLeft"]] == 0.4


def test_an_avatar_whose_eyes_are_compressed_is_told(run, quick_model_folder: Path, tmp_path: Path):
    np.save(tmp_path / "take.npy", _take())
    worn = compressed(tmp_path / "a.glb")
    options = ("--fps", 25, "--gltf", worn, "--out", tmp_path / "b.glb")
    code, _, err = run("predict", quick_model_folder, tmp_path / "take.npy", *options)
    assert code == 0, err
    assert f"{worn} is compressed, which hides whether morph targets turn its eyes" in err


@pytest.mark.parametrize(
    ("left", "right", "share"), [(0.9, 0.0, 0), (0.1, 0.8, 0), (0.9, 0.9, 1), (0.3, 0.2, 1), (0.35, 0, 0.5)]
)
def test_a_wink_is_no_gaze_and_a_blink_may_be(left: float, right: float, share: float):
    answer = Looks(fade=True).step(_sample(0, GUESS | {"eyeBlinkLeft": left, "eyeBlinkRight": right}))
    assert answer.weights[LOOKS].max() == pytest.approx(0.4 * share)


def test_irises_go_before_guesses_whatever_the_turn():
    answer = Looks(fade=True).step(_sample(30, GUESS | {"eyeBlinkLeft": 0.9}, irises=True, gaze_deg=-15))
    assert answer.weights[BLENDSHAPE_INDEX["eyeLookInLeft"]] == pytest.approx(0.5, abs=0.06)
    assert answer.weights[BLENDSHAPE_INDEX["eyeLookOutRight"]] == pytest.approx(0.5, abs=0.06)
    assert answer.weights[BLENDSHAPE_INDEX["eyeLookOutLeft"]] == 0
    assert answer.confidence[LOOKS].tolist() == [1.0] * 8
    np.testing.assert_allclose(np.degrees(answer.gaze), [-15, 0, -15, 0], atol=2)


def test_a_frame_without_irises_in_a_take_with_them_is_guessed():
    sample = replace(_sample(0, GUESS), gaze=np.full(4, np.nan))
    for fade in (True, False):
        answer = Looks(fade=fade).step(sample)
        assert answer.weights[BLENDSHAPE_INDEX["eyeLookOutLeft"]] == 0.4
        np.testing.assert_allclose(np.degrees(answer.gaze), [12, 0, 12, 0])
    nowhere = replace(sample, weights=np.full(52, np.nan))
    assert Looks(fade=True).step(nowhere) is nowhere


@pytest.mark.parametrize("name", [None, *FILTERS])
@pytest.mark.parametrize("at_once", [True, False])
def test_no_irises_are_irises_that_are_not_seen(name: str | None, at_once: bool, quick_model: Model):
    """In Python a frame may lack them: it is guessed by every filter, and in the table's columns."""
    take = _take()
    samples = [
        Sample(
            label=str(row),
            time_s=row / 30,
            points=face[:68],
            irises=None if row in (2, 3) else face[[69, 68]],
        )
        for row, face in enumerate(take)
    ]

    def table(samples: list[Sample]) -> list[list[str]]:
        chain = landmark_chain(quick_model, Output(filter=name), head=HeadSettings(camera=PICTURE))
        answers = chain.run(samples) if at_once else list(chain.stream(samples))
        return list(csv.reader(csv_lines(answers, BLENDSHAPES)))

    unseen = [
        replace(sample, irises=np.full((2, 2), np.nan)) if sample.irises is None else sample
        for sample in samples
    ]
    assert table(samples) == table(unseen)
    assert {len(row) for row in table(samples)} == {2 + 52 + 4 + 6}
    with pytest.raises(InputError, match="frame 4 has irises and the take's first frame has none"):
        table(samples[2:])


def test_an_eye_whose_iris_is_not_known_goes_with_the_other_one():
    face, irises, pose = seen(np.zeros(3), np.radians([12.0, 4, 12, 4]))
    irises[1] = np.nan
    one = gaze_angles(face[None], irises[None], pose, CAMERA, MEAN_EYES)[0]
    np.testing.assert_allclose(np.degrees(one), [[12, 4], [12, 4]], atol=0.5)
    irises[0] = np.nan
    assert np.isnan(gaze_angles(face[None], irises[None], pose, CAMERA, MEAN_EYES)).all()


@given(yaw=within(40), pitch=within(15))
def test_the_quick_yaw(yaw: float, pitch: float):
    face, _, _ = seen(np.array([yaw, pitch, 0]), np.zeros(4))
    assert np.degrees(yaw_of(face) - yaw) == pytest.approx(0, abs=6)


def _take(count: int = 6) -> np.ndarray:
    """Faces with irises behind them (count, 70, 2): first straight ahead, then to and fro; one eye is not seen once."""
    rows = []
    for row in range(count):
        face, irises, _ = seen(np.radians([2.0 * row, 0, 0]), np.radians([5.0 * row, 0, 5.0 * row, 0]))
        rows.append(np.concatenate([face, irises[::-1]]))
    take = np.array(rows)
    take[4, 69] = np.nan
    return take


def _table(path: Path, take: np.ndarray) -> Path:
    names = [f"{axis}_{index}" for index in range(70) for axis in "xy"]
    lines = [
        ",".join(names),
        *(",".join("" if np.isnan(v) else repr(float(v)) for v in row.ravel()) for row in take),
    ]
    path.write_text("\n".join(lines) + "\n")
    return path


def test_readers_agree_on_irises(tmp_path: Path):
    take = _take()
    np.save(tmp_path / "take.npy", take)
    lines = [" ".join(map(repr, row.ravel().tolist())) for row in take]
    samples = list(read_lines(["", *lines, lines[0].rsplit(" ", 4)[0]]))
    of_lines = np.array([sample.irises for sample in samples])
    assert np.isnan(of_lines[[0, -1]]).all()
    assert np.isfinite(samples[-1].points).all()
    for frames in (read_frames(tmp_path / "take.npy"), read_frames(_table(tmp_path / "take.csv", take))):
        np.testing.assert_array_equal(frames.points, take[:, :LANDMARK_COUNT])
        np.testing.assert_array_equal(frames.irises, take[:, [69, 68]])
        np.testing.assert_array_equal(frames.irises, of_lines[1:-1])
    assert read_frames(_table(tmp_path / "take.csv", take)).take([1, 2]).irises.shape == (2, 2, 2)


@pytest.mark.parametrize("fps", [None, 30.0])
@pytest.mark.parametrize("first", ["", "no frame"])
def test_the_first_face_of_a_pipe_says_whether_there_are_irises(first: str, fps: float | None):
    take = _take()
    lines = [first, *(" ".join(map(repr, row.ravel().tolist())) for row in take)]
    samples = list(read_lines(lines, fps=fps))
    np.testing.assert_array_equal([sample.irises for sample in samples[1:]], take[:, [69, 68]])
    assert np.isnan(samples[0].irises).all()
    assert [sample.time_s for sample in samples[:2]] == ([0, 1 / 30] if fps else [None, None])


@pytest.mark.parametrize("kind", ["npy", "csv", "pipe"])
def test_from_irises_to_a_table(kind: str, run, quick_model_folder: Path, tmp_path: Path, monkeypatch):
    """The gaze leaves in degrees, and its shapes in place of the networks'; a neutral frame says what ahead is."""
    take = _take()
    np.save(tmp_path / "take.npy", take)
    np.save(tmp_path / "rest.npy", take[:1])
    path = {"npy": tmp_path / "take.npy", "csv": _table(tmp_path / "take.csv", take), "pipe": "-"}[kind]
    lines = [" ".join(map(repr, row.ravel().tolist())) for row in take]
    monkeypatch.setattr(sys, "stdin", io.StringIO("\n".join(lines) + "\n"))
    camera = ("--picture", "1280x720", "--focal-px", 900)
    code, out, err = run("predict", quick_model_folder, path, "--neutral", tmp_path / "rest.npy", *camera)
    assert code == 0, err
    rows = list(csv.DictReader(io.StringIO(out)))
    for row in (1, 2, 3, 5):
        assert float(rows[row]["left_eye_yaw_deg"]) == pytest.approx(5 * row, abs=1.5)
        assert float(rows[row]["eyeLookInRight"]) == pytest.approx(5 * row / 30, abs=0.05)
        assert float(rows[row]["eyeLookOutRight"]) == 0
    assert float(rows[0]["right_eye_pitch_deg"]) == pytest.approx(0, abs=0.2)
    assert rows[4]["left_eye_yaw_deg"] != ""


def test_an_option_keeps_guessed_gaze_and_without_it_looks_alone_differ(
    run, quick_model: Model, quick_model_folder: Path, tmp_path: Path
):
    """--keep-guessed-gaze leaves the networks' weights; without it only the eight shapes differ."""
    np.save(tmp_path / "take.npy", np.array([seen(np.radians([30.0, 0, 0]), np.zeros(4))[0]]))
    tables = [
        next(csv.DictReader(io.StringIO(run("predict", quick_model_folder, tmp_path / "take.npy", *more)[1])))
        for more in ((), ("--keep-guessed-gaze",))
    ]
    changed = {name for name, cell in tables[0].items() if cell != tables[1][name]}
    networks = quick_model.predict(np.load(tmp_path / "take.npy"))[0]
    kept = [float(tables[1][BLENDSHAPES[index]]) for index in LOOKS]
    assert kept == pytest.approx(networks[list(LOOKS)], abs=1e-5)
    assert changed
    assert changed <= {BLENDSHAPES[index] for index in LOOKS}
    assert all(float(tables[0][BLENDSHAPES[index]]) == 0 for index in LOOKS)


@pytest.mark.parametrize("scale", [1.0, 1e14, 1e-13])
@pytest.mark.parametrize("iris", [0.0, np.nan, np.inf, 1e300, -1.7e308])
@pytest.mark.parametrize(
    "camera",
    [
        CameraSettings(),
        CameraSettings(picture_px=(1, 1), fov_deg=150.0),
        CameraSettings(focal_px=1.0),
        CameraSettings(focal_px=1e6),
    ],
)
def test_irises_and_cameras_that_nobody_has(scale: float, iris: float, camera: CameraSettings):
    """Weights stay numbers, and nothing is computed that warns."""
    face, _, _ = seen(np.zeros(3), np.zeros(4))
    irises = np.full((2, 2), iris)
    for settings in (
        HeadSettings(camera=camera),
        HeadSettings(camera=camera, neutral=scale * face[None], neutral_irises=irises[None]),
    ):
        sample = Sample(points=scale * face, irises=irises, weights=np.zeros(52))
        answer = Looks(fade=True).step(HeadPose(settings).step(sample))
        assert np.isfinite(answer.weights).all()
        assert np.isfinite(answer.gaze).all()
