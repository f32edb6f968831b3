"""Corners of eyes: skin that pulls at them does not move the gaze, a headset that slips does not either."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.cli.headset_input import read_footage
from regress.runtime.headset.answers.eye_reader import EyeReader
from regress.runtime.headset.eyes.eye_corners import EyeCorners, calm_corners
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.headset.person.person import OwnEye, Person
from tests.regress.headset.test_traced_eyes import EYE, seen_points

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
IRIS_PX = 30.0


def followed(middles: np.ndarray, *, fps: float, shut: np.ndarray | None = None) -> np.ndarray:
    corners = EyeCorners()
    shut = np.zeros(len(middles), dtype=bool) if shut is None else shut
    return np.array(
        [
            corners.step(1 / fps, one, iris=IRIS_PX, shut=bool(closed))
            for one, closed in zip(middles, shut, strict=True)
        ]
    )


@given(st.sampled_from([30.0, 90.0, 200.0]), st.integers(0, 2**32 - 1))
def test_skin_that_pulls_at_corners_hardly_moves_them(fps: float, seed: int):
    random = np.random.default_rng(seed)
    pulled = np.array([40.0, 50.0]) + 0.03 * IRIS_PX * random.standard_normal((int(3 * fps), 2))
    off = np.linalg.norm(followed(pulled, fps=fps) - [40, 50], axis=1)
    assert off[int(fps) :].mean() < 0.4 * np.linalg.norm(pulled - [40, 50], axis=1).mean()


@given(st.floats(-3, 3), st.sampled_from([30.0, 90.0]))
def test_a_headset_that_slips_is_followed_about_a_second_behind(pixels_a_second: float, fps: float):
    seconds = np.arange(int(6 * fps)) / fps
    found = followed(np.column_stack([pixels_a_second * seconds, 0 * seconds]), fps=fps)
    behind_s = seconds[-1] - found[-1, 0] / pixels_a_second if abs(pixels_a_second) > 0.1 else 1.0
    assert 0.8 < behind_s < 1.2


@given(st.floats(0, 2 * np.pi), st.floats(0.3, 3))
def test_a_picture_that_is_cut_out_anew_is_followed_at_once(way: float, irises: float):
    moved = np.tile([40.0, 50.0], (40, 1))
    moved[30:] += irises * IRIS_PX * np.array([np.cos(way), np.sin(way)])
    np.testing.assert_allclose(followed(moved, fps=30), moved)


def test_shut_eyes_do_not_count_and_eyes_that_are_away_are_forgotten():
    shut = np.zeros(40, dtype=bool)
    shut[20:30] = True
    pulled = np.where(shut[:, None], [43.0, 56.0], [40.0, 50.0])
    np.testing.assert_allclose(followed(pulled, fps=30, shut=shut), np.tile([40.0, 50.0], (40, 1)))
    away = np.tile([40.0, 50.0], (20, 1))
    away[10], away[11:] = np.nan, [42.0, 50.0]
    found = followed(away, fps=30)
    assert np.isnan(found[10]).all()
    np.testing.assert_allclose(found[11:], away[11:])
    # of an eye that was never open nothing better is known
    np.testing.assert_allclose(followed(pulled[25:30], fps=30, shut=np.ones(5, dtype=bool)), pulled[25:30])


def test_in_a_take_frames_behind_count_as_those_before():
    points = seen_points(np.zeros((31, 2)), np.full(31, 9.0), pixels_a_mm=2.5, turn_deg=0.0)
    random = np.random.default_rng(0)
    for corner in (EYE.upper[0], EYE.upper[-1]):
        points[:, corner] += random.standard_normal((31, 2))
    both = {"iris": 29.0, "shut": np.zeros(31, dtype=bool), "seconds": np.full(31, 1 / 30)}
    found = calm_corners(points, EYE, **both)
    np.testing.assert_allclose(calm_corners(points[::-1], EYE, **both)[::-1], found)
    alone = points[:, [EYE.upper[0], EYE.upper[-1]]].mean(axis=1)
    assert np.linalg.norm(found - 48, axis=1).max() < 0.5 * np.linalg.norm(alone - 48, axis=1).max()


@pytest.mark.parametrize("model", ["headset-tracking3", "headset-any"])
def test_a_cheek_that_pulls_at_the_corners_for_a_frame_does_not_move_the_gaze(model: str):
    predictor = load_headset_predictor(model)
    take = read_footage(predictor, None, {"left_eye": TAKE / "left_eye"}, from_start=False, fps=None)
    seen = {"left_eye": take.pictures["left_eye"][0]}
    points = predictor.graph.trace({name: picture[None] for name, picture in seen.items()})["left_eye"][0]
    pulled = points.copy()
    eye = EyePoints.of(predictor, "left_eye")
    pulled[[eye.upper[0], eye.upper[-1]]] += 2.0
    straight = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    reader = EyeReader(
        predictor, Person(eyes={"left_eye": OwnEye(traced=straight, direct=straight, traced_share=1.0)})
    )
    for _ in range(60):
        _, calm = reader.read(1 / 30, seen, {"left_eye": points}, np.zeros(4))
    _, moved = reader.read(1 / 30, seen, {"left_eye": pulled}, np.zeros(4))
    # by its own corners it would turn by four degrees and more each way
    assert np.degrees(np.abs(moved[:2] - calm[:2])).max() < 0.5
