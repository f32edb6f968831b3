"""Lids and gaze from traced points, on eyes whose truth is known, and as `predict --eyes` writes them."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.cli.headset_input import read_footage
from regress.runtime.headset.answers.eye_reader import HALF_SHUT, EyeReader
from regress.runtime.headset.answers.traced_eyes import eye_features, traced_eyes
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.eyes.gaze_map import IRIS_MM
from regress.runtime.headset.eyes.own_gaze import corrected, fused, own_gaze
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.person.person import OwnEye, Person

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
LIDS, IRIS = 12, 8
EYE = EyePoints(
    pupil=0,
    iris=list(range(1, 1 + IRIS)),
    upper=list(range(9, 9 + LIDS)),
    lower=list(range(9 + LIDS, 9 + 2 * LIDS)),
    brow=[],
    usual=np.zeros((9 + 2 * LIDS, 2)),
)
BALL_MM, CORNERS_MM = 10.4, 15.0
"""From an eyeball's middle to the middle of its iris; from there to a corner of the eye."""


def seen_points(
    gaze_deg: np.ndarray, open_mm: np.ndarray, *, pixels_a_mm: float, turn_deg: float
) -> np.ndarray:
    """Points (n, P, 2) of an eye that a distant camera sees head-on, with the picture turned.

    Yaw is to the picture's right, pitch upwards; lids are parabolas between the corners.
    """
    yaw, pitch = np.radians(gaze_deg).T
    middle = BALL_MM * np.column_stack([np.sin(yaw) * np.cos(pitch), -np.sin(pitch)])
    around = 2 * np.pi * np.arange(IRIS) / IRIS
    iris = middle[:, None] + IRIS_MM / 2 * np.column_stack([np.cos(around), np.sin(around)])
    across = np.linspace(-1, 1, LIDS)
    lid = np.stack(
        [np.tile(CORNERS_MM * across, (len(yaw), 1)), open_mm[:, None] / 2 * (1 - across**2)], axis=2
    )
    points = np.concatenate([middle[:, None], iris, lid * [1, -1], lid], axis=1)
    angle = np.radians(turn_deg)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return pixels_a_mm * points @ turn.T + 48


@given(st.floats(1, 8), st.floats(-20, 20), st.floats(0, 14))
def test_lengths_are_in_irises_whatever_the_camera(pixels_a_mm: float, turn_deg: float, open_mm: float):
    gaze = np.array([[0.0, 0.0], [10.0, -5.0]])
    points = seen_points(gaze, np.array([open_mm, open_mm / 2]), pixels_a_mm=pixels_a_mm, turn_deg=turn_deg)
    pupil, apart = eye_features(points, EYE)
    mean_of_parabola = (1 - np.linspace(-1, 1, LIDS) ** 2).mean()
    np.testing.assert_allclose(IRIS_MM * apart, np.array([1, 0.5]) * open_mm * mean_of_parabola, atol=1e-9)
    np.testing.assert_allclose(pupil[0], [0, 0], atol=1e-9)
    np.testing.assert_allclose(
        np.linalg.norm(IRIS_MM * pupil[1]) / BALL_MM, np.sin(np.radians(11.17)), rtol=1e-3
    )


@pytest.mark.parametrize(("count", "within_deg"), [(1, 6.0), (5, 1.6), (9, 1.3)])
def test_targets_find_the_gaze_of_another_eye_and_camera(count: int, within_deg: float):
    random = np.random.default_rng(count)
    field = np.array([[0, 0], [-15, 0], [15, 0], [0, 12], [0, -12], [-12, 9], [12, 9], [-12, -9], [12, -9]])
    true = np.concatenate([field[:count], random.uniform([-18, -14], [18, 14], (200, 2))]).astype(float)
    points = seen_points(true, np.full(len(true), 9.0), pixels_a_mm=2.5, turn_deg=12.0)
    pupil, _ = eye_features(points + 0.2 * random.standard_normal(points.shape), EYE)
    # the map of a larger eyeball: its angles are short by a quarter, turned by the camera's roll, and displaced
    said = np.array([4.0, -3.0]) + np.degrees(pupil * [1, -1] * IRIS_MM / (1.33 * BALL_MM))
    rows = list(range(count))
    better = corrected(said, said[rows], true[rows])
    error = np.linalg.norm(better - true, axis=1)[count:].mean()
    assert error < within_deg
    assert error < 0.8 * np.linalg.norm(said - true, axis=1)[count:].mean()


def test_fusing_leans_on_the_answer_that_meets_the_targets():
    random = np.random.default_rng(0)
    true = random.uniform(-15, 15, (300, 2))
    good, poor = (true + sd * random.standard_normal(true.shape) for sd in (1.0, 6.0))
    rows = list(range(9))
    both = fused([poor, good], rows, true[rows])

    def error(gaze: np.ndarray) -> float:
        return float(np.linalg.norm(gaze - true, axis=1)[9:].mean())

    assert error(both) < 1.15 * error(corrected(good, good[rows], true[rows]))
    assert error(both) < 0.5 * error(corrected(poor, poor[rows], true[rows]))
    np.testing.assert_array_equal(fused([poor, good], [], np.zeros((0, 2))), poor)
    one = fused([poor, good], [4], true[[4]])
    np.testing.assert_allclose(one[4], true[4])


def predicted(run, tmp_path: Path, *options: object) -> np.ndarray:
    table = tmp_path / "eyes.csv"
    words = [
        "headset",
        "predict",
        "headset-tracking3",
        "--left-eye",
        TAKE / "left_eye",
        "--out",
        tmp_path / "w.csv",
    ]
    code, _, said = run(*words, "--eyes", table, *options)
    assert code == 0, said
    return np.genfromtxt(table, delimiter=",", names=True, deletechars="")


def test_predict_writes_eyes_and_takes_what_was_looked_at(run, tmp_path: Path):
    eyes = predicted(run, tmp_path)
    weights = np.genfromtxt(tmp_path / "w.csv", delimiter=",", names=True)
    assert len(eyes) == len(weights) == 100
    assert np.corrcoef(eyes["left_eye.openness"], weights["eyeBlinkLeft"])[0, 1] < -0.8
    assert 3 < np.median(eyes["left_eye.openness_mm"]) < 12
    seen = eyes["left_eye.openness"] > HALF_SHUT  # of a hidden pupil the points say nothing
    assert seen.sum() > 80
    for angle, least in (("yaw", 0.9), ("pitch", 0.7)):
        traced, direct = eyes[f"left_eye.{angle}_deg"][seen], weights[f"left_eye_{angle}_deg"][seen]
        assert np.corrcoef(traced, direct)[0, 1] > least
    moved = predicted(run, tmp_path, "--looked-at", "3:-7:5")
    # the frames about it are of the same look, and count too
    assert moved["left_eye.yaw_deg"][3] == pytest.approx(-7, abs=1.5)
    assert moved["left_eye.pitch_deg"][3] == pytest.approx(5, abs=1.5)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--looked-at", "3:0"], "--looked-at '3:0' is not FRAME:YAW:PITCH"),
        (["--looked-at", "3:nan:0"], "is not FRAME:YAW:PITCH"),
        (["--looked-at", "3:61:0"], "angles up to 60 degrees"),
        (["--looked-at", "3:0:0", "--looked-at", "3:5:0"], "names frame 3 twice"),
        (["--looked-at", "900:0:0"], "no frame of"),
    ],
)
def test_targets_that_are_none_are_refused(run, tmp_path: Path, options: list[str], said: str):
    words = [
        "headset",
        "predict",
        "headset-tracking3",
        "--left-eye",
        TAKE / "left_eye",
        "--out",
        tmp_path / "w.csv",
    ]
    code, _, told = run(
        *words, "--eyes", tmp_path / "eyes.csv", "--points", tmp_path / "points.csv", *options
    )
    assert (code, said in told) == (2, True), told
    assert not list(tmp_path.glob("*.csv"))
    code, _, told = run(*words, "--looked-at", "3:0:0")
    assert (code, "give --eyes too" in told) == (2, True)


def test_a_picture_that_does_not_count_says_nothing_of_the_other_eye(tmp_path: Path):
    shutil.copytree(TAKE / "right_eye", tmp_path / "right")
    for path in sorted((tmp_path / "right").iterdir())[40:]:
        path.unlink()
    given = {"left_eye": TAKE / "left_eye", "right_eye": tmp_path / "right"}
    predictor = load_headset_predictor("headset-tracking3")
    footage = read_footage(predictor, None, given, from_start=False, fps=None)
    white = footage.pictures["right_eye"].copy()
    white[40:] = 255
    other = replace(footage, pictures={**footage.pictures, "right_eye": white})
    targets = {row: (row - 20.0, 5.0) for row in (0, 10, 20, 30, 35)}
    eyes, again = (traced_eyes(predictor, take, targets) for take in (footage, other))
    assert len(eyes["left_eye"].gaze_deg) == 100
    np.testing.assert_array_equal(again["left_eye"].gaze_deg, eyes["left_eye"].gaze_deg)
    assert np.isnan(eyes["right_eye"].gaze_deg[40:]).all()


def test_of_many_headsets_the_direct_gaze_leads_at_home_where_no_target_decides():
    predictor = load_headset_predictor("headset-any")
    footage = read_footage(predictor, None, {"left_eye": TAKE / "left_eye"}, from_start=False, fps=None)
    eyes = traced_eyes(predictor, footage)
    direct, _ = predictor.graph.see({"left_eye": footage.pictures["left_eye"]}, present=footage.present)
    off = np.abs(eyes["left_eye"].gaze_deg - np.degrees(direct.gaze[:, 0]))
    # by geometry alone the middle would be seventeen degrees lower
    assert np.median(off) < 0.5
    assert off.max() < 4


def left_eye_seen() -> tuple[HeadsetPredictor, dict[str, np.ndarray], dict[str, np.ndarray]]:
    """A network, a picture of a left eye, and the points that it traces there."""
    predictor = load_headset_predictor("headset-tracking3")
    take = read_footage(predictor, None, {"left_eye": TAKE / "left_eye"}, from_start=False, fps=None)
    seen = {"left_eye": take.pictures["left_eye"][0]}
    traced = predictor.graph.trace({name: picture[None] for name, picture in seen.items()})
    return predictor, seen, {name: points[0] for name, points in traced.items()}


def test_of_two_cameras_on_one_eye_the_surer_one_says_the_gaze_and_corrects_it_once():
    predictor, seen, points = left_eye_seen()
    shift = ((1.0, 0.0, -8.0), (0.0, 1.0, 0.0))
    sure, unsure = (
        OwnEye(direct=shift, error_deg=1.0),
        OwnEye(direct=((1.0, 0.0, 9.0), shift[1]), error_deg=2.0),
    )

    def gaze_of(first: OwnEye, second: OwnEye) -> float:
        reader = EyeReader(predictor, None)
        reader._eyes["left_eye_nasal"], reader._own = (
            reader._eyes["left_eye"],
            {"left_eye": first, "left_eye_nasal": second},
        )
        for table in (
            reader._maps,
            reader.sides,
            reader._irises,
            reader._corners,
            reader._leads,
            reader._pupils,
            reader._usual,
        ):
            table["left_eye_nasal"] = table["left_eye"]
        both = {"left_eye": seen["left_eye"], "left_eye_nasal": seen["left_eye"]}
        _, gaze = reader.read(
            1 / 30, both, dict.fromkeys(both, points["left_eye"]), np.radians([8.0, 0.0, 8.0, 0.0])
        )
        return float(np.degrees(gaze[0]))

    alone = EyeReader(predictor, Person(eyes={"left_eye": sure}))
    _, gaze = alone.read(1 / 30, seen, points, np.radians([8.0, 0.0, 8.0, 0.0]))
    assert (
        gaze_of(sure, unsure)
        == pytest.approx(gaze_of(unsure, sure))
        == pytest.approx(float(np.degrees(gaze[0])))
    )
    assert gaze_of(sure, sure) == pytest.approx(float(np.degrees(gaze[0])))


@pytest.mark.parametrize("error_deg", [0.5, 3.0])
def test_an_eye_that_is_seen_leads_one_that_no_camera_sees(error_deg: float):
    """Whatever the network guesses of the other: that one looks as high, and meets it in front."""
    predictor, seen, points = left_eye_seen()
    person = Person(eyes={"left_eye": OwnEye(error_deg=error_deg)})
    read = []
    for guess_deg in (-20.0, 0.0, 20.0):
        reader = EyeReader(predictor, person)
        _, gaze = reader.read(1 / 30, seen, points, np.radians([5.0, 3.0, guess_deg, guess_deg]))
        read.append(np.degrees(gaze))
    yaw_and_pitch, other_pitch = np.array(read)[:, :2], np.array(read)[:, 3]
    np.testing.assert_allclose(yaw_and_pitch, np.tile(yaw_and_pitch[1], (3, 1)), atol=0.05)
    np.testing.assert_allclose(other_pitch, yaw_and_pitch[:, 1], atol=0.05)


@pytest.mark.parametrize("fps", [30, 120, 200])
def test_shut_eyes_leave_an_iris_as_large_as_it_was_for_as_many_seconds_at_any_frame_rate(fps: int):
    """Of a shut eye a smaller iris is traced; after four seconds of each, the open ones still say its size."""
    predictor, seen, points = left_eye_seen()
    small = points["left_eye"].copy()
    iris = EyePoints.of(predictor, "left_eye").iris
    small[iris] = small[iris].mean(axis=0) + 0.5 * (small[iris] - small[iris].mean(axis=0))
    reader = EyeReader(predictor, None)
    gaze = np.zeros(4)
    for _ in range(4 * fps):
        usual, _ = reader.read(1 / fps, seen, points, gaze)
    for _ in range(round(3.5 * fps)):
        shut, _ = reader.read(1 / fps, seen, {"left_eye": small}, gaze)
    assert shut.openness_mm[0] == pytest.approx(usual.openness_mm[0], rel=0.02)


def test_an_eye_that_was_away_shows_no_pupil_of_before():
    predictor, seen, points = left_eye_seen()
    reader = EyeReader(predictor, None)
    before, _ = reader.read(1 / 30, seen, points, np.zeros(4))
    away, _ = reader.read(1 / 30, {}, {}, np.zeros(4))
    assert np.isfinite(before.pupil[0])
    assert np.isnan(away.pupil[0])
    bright = {"left_eye": np.full_like(seen["left_eye"], 200)}
    back, _ = reader.read(1 / 30, bright, points, np.zeros(4))
    assert back.pupil[0] != before.pupil[0]


@pytest.mark.parametrize("count", [5, 9])
def test_errors_at_targets_are_those_of_fresh_looks(count: int):
    """Six numbers fit five targets well: residuals at them say two thirds of what other looks are off by."""
    rng = np.random.default_rng(count)
    said, fresh, favoured = [], [], []
    for _ in range(400):
        targets, others = rng.uniform(-20, 20, (2, count, 2))
        good, bad = (targets + rng.normal(0, sd, targets.shape) for sd in (2.0, 4.0))
        own = own_gaze([good, bad], targets)
        said.append(own.error_deg**2)
        looks = own.apply([others + rng.normal(0, sd, others.shape) for sd in (2.0, 4.0)])
        fresh.append(((looks - others) ** 2).sum(axis=1).mean())
        favoured.append(own.shares[0] > 0.5)
    assert np.sqrt(np.mean(said)) == pytest.approx(np.sqrt(np.mean(fresh)), rel=0.25)
    assert np.mean(favoured) > 0.85


def test_few_targets_share_answers_by_fresh_looks():
    """Six numbers bend even an answer that knows nothing to five targets."""
    rng = np.random.default_rng(5)
    shares, fresh = [], []
    for _ in range(400):
        targets, others = rng.uniform(-20, 20, (2, 5, 2))
        spreads = (2.0, 30.0)
        looked, looks = (
            [true + rng.normal(0, sd, true.shape) for sd in spreads] for true in (targets, others)
        )
        shares.append(own_gaze(looked, targets).shares[1])
        better = [corrected(look, at, targets) for look, at in zip(looks, looked, strict=True)]
        fresh.append([((look - others) ** 2).sum(axis=1).mean() for look in better])
    good, bad = np.mean(fresh, axis=0)
    assert np.mean(shares) < 1.6 * good / (good + bad)


def test_predict_names_a_target_that_was_not_looked_at(run, tmp_path: Path):
    eyes = predicted(run, tmp_path)
    rows = np.flatnonzero(eyes["left_eye.openness"] > 0.8)[::8][:9]
    looks = {row: (eyes["left_eye.yaw_deg"][row], eyes["left_eye.pitch_deg"][row]) for row in rows}
    wrong = int(rows[4])
    looks[wrong] = (looks[wrong][0] - 25, looks[wrong][1])
    words = ["headset", "predict", "headset-tracking3", "--left-eye", TAKE / "left_eye", "--eyes"]
    looked_at = [
        word for row, (yaw, pitch) in looks.items() for word in ("--looked-at", f"{row}:{yaw}:{pitch}")
    ]
    code, _, said = run(*words, tmp_path / "eyes.csv", "--out", tmp_path / "w.csv", *looked_at)
    assert code == 0, said
    told = [line for line in said.splitlines() if "--looked-at" in line]
    assert told == [
        f"--looked-at {wrong}: left_eye was shut or looked elsewhere there; the target is left out"
    ]
