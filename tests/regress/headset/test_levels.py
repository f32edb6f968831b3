"""Levels of pictures: what lies in training's range stays, other pictures are brought there, live ones soon too."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.exporters.headset_interface import interface_of
from regress.runtime.headset.footage import line_up
from regress.runtime.headset.levels import Levels, level_table, levelled, tables_of
from regress.runtime.headset.looks import CameraLooks, flicker_of, levels_of, looks_of, rim_of, sharpness_of
from regress.runtime.headset.placement import CameraPlacement
from regress.runtime.headset.predictor import load_headset_predictor
from tests.regress.headset.takes import HEIGHT, WIDTH, pictures, recording

LOOKS = CameraLooks(
    low=(12.0, 14.0, 16.0),
    high=(115.0, 143.0, 177.0),
    saturated=(0.0, 0.0, 0.001),
    sharpness=(0.1, 0.13, 0.17),
    rim=(0.0, 0.0, 0.0),
)
levels = st.floats(0, 255)


@given(st.floats(12, 16), st.floats(115, 177))
def test_levels_of_training_stay(low: float, high: float):
    np.testing.assert_array_equal(level_table(low, high, LOOKS), np.arange(256))


@given(levels, levels, st.booleans())
def test_levels_keep_their_order_and_reach_trainings_range(low: float, high: float, fixed: bool):
    low, high = min(low, high), max(low, high)
    table = level_table(low, high, LOOKS, fixed=fixed).astype(int)
    assert (np.diff(table) >= 0).all()
    if high - low < 8:
        return
    at_low, at_high = table[round(low)], table[round(high)]
    slope = (LOOKS.high[2] - LOOKS.low[0]) / (high - low)
    within = 0.5 * slope + 0.5  # of a level that is no whole number
    if fixed:
        assert at_low == pytest.approx(14, abs=within)
        assert at_high == pytest.approx(143, abs=within)
    else:
        assert 12 - within <= at_low <= 16 + within
        assert 115 - within <= at_high <= 177 + within


def test_a_flat_picture_is_not_stretched_to_noise():
    table = level_table(100.0, 100.0, LOOKS).astype(int)
    assert np.diff(table).max() <= 14


def take(means, **changes):
    made = recording("left_eye", pictures(means), **changes)
    return line_up({"left_eye": made}, {"left_eye": (WIDTH, HEIGHT), "mouth": (WIDTH, HEIGHT)})


def test_a_bright_take_is_levelled_and_pictures_at_fault_stay_black():
    footage = take(np.full(20, 200.0))
    tables = tables_of(footage, {"left_eye": LOOKS, "mouth": LOOKS}, {})
    assert list(tables) == ["left_eye"]
    low, high = levels_of(levelled(footage, tables).pictures["left_eye"])
    assert (low, high) == (pytest.approx(16, abs=3), pytest.approx(177, abs=3))
    assert levels_of(footage.pictures["left_eye"])[0] > 150  # the take itself is left alone
    dark = replace(footage, faults={**footage.faults, "left_eye": (None,) * 19 + footage.faults["mouth"][:1]})
    assert (levelled(dark, tables).pictures["left_eye"][:19] != footage.pictures["left_eye"][:19]).any()
    np.testing.assert_array_equal(
        levelled(dark, tables).pictures["left_eye"][19], dark.pictures["left_eye"][19]
    )


def test_a_placements_levels_go_first():
    footage = take(np.full(20, 80.0))
    named = {"left_eye": CameraPlacement(low=60.0, high=100.0)}
    table = tables_of(footage, {"left_eye": LOOKS}, named)["left_eye"]
    assert (table[60], table[100]) == (14, 143)
    live = Levels({"left_eye": LOOKS}, named)
    picture = footage.pictures["left_eye"][0]
    np.testing.assert_array_equal(live.step(1 / 30, {"left_eye": picture})["left_eye"], table[picture])


def test_live_levels_become_those_of_the_take():
    stack = pictures(np.tile([190.0, 200, 210, 205], 100))
    footage = take(np.tile([190.0, 200, 210, 205], 100))
    table = tables_of(footage, {"left_eye": LOOKS}, {})["left_eye"]
    live = Levels({"left_eye": LOOKS})
    for picture in stack:
        seen = live.step(1 / 30, {"left_eye": picture, "mouth": picture})
    np.testing.assert_array_equal(seen["mouth"], stack[-1])  # of a camera that the model says nothing of
    assert np.abs(seen["left_eye"].astype(int) - table[stack[-1]]).max() <= 4
    # neutral pictures get the same levels as frames
    np.testing.assert_array_equal(live.levelled({"left_eye": stack[-1]})["left_eye"], seen["left_eye"])


@pytest.mark.parametrize("fps", [15, 30, 120, 200])
def test_live_levels_follow_a_lamp_in_as_many_seconds_at_any_frame_rate(fps: int):
    """Of a lamp that went out half is forgotten in seven seconds."""
    bright, dark = pictures(np.array([200.0, 60.0]))
    live = Levels({"left_eye": LOOKS})
    for _ in range(60 * fps):
        live.step(1 / fps, {"left_eye": bright})
    shown = []
    for _ in range(40 * fps):
        shown.append(levels_of(live.step(1 / fps, {"left_eye": dark})["left_eye"])[1])
    followed_s = np.flatnonzero(np.array(shown) > 100)[0] / fps
    assert 20 < followed_s < 40


def test_looks_say_what_was_done_to_pictures():
    random = np.random.default_rng(0)
    face = np.clip(90 + 40 * random.standard_normal((24, 24)), 20, 240).repeat(4, 0).repeat(4, 1)
    take = np.clip(face + 2 * random.standard_normal((30, 96, 96)), 0, 255).astype(np.uint8)
    plain = looks_of(take)
    import cv2

    soft = np.stack([cv2.GaussianBlur(one, (0, 0), 3) for one in take])
    assert sharpness_of(soft) < 0.7 * plain.sharpness
    flickering = np.clip(take * np.where(np.arange(30) % 2, 1.0, 0.85)[:, None, None], 0, 255).astype(
        np.uint8
    )
    assert plain.flicker < 0.02 < 0.1 < flicker_of(flickering)
    waves = 1 + 0.12 * np.sin(np.arange(96) / 8 + 2 * np.arange(30)[:, None])
    rolling = np.clip(take * waves[:, :, None], 0, 255).astype(np.uint8)
    assert flicker_of(rolling) > 0.05
    rows, columns = np.mgrid[:96, :96]
    rim = (rows - 48) ** 2 + (columns - 48) ** 2 > 40**2
    dark = np.where(rim, 9, take).astype(np.uint8)
    assert rim_of(dark) == pytest.approx(rim.mean(), abs=0.02)
    assert plain.rim == rim_of(take) < 0.02


def test_other_programs_know_what_a_placement_s_levels_become():
    """By `levels.middle` of headset.json, as docs/your-camera.md has it: of the ranges' ends weights differ by .16."""
    model = load_headset_predictor("headset-tracking3").model
    for name, exported in interface_of(model, graph="g.onnx")["levels"].items():
        dark, bright = exported["middle"]
        expected = np.rint(dark + (bright - dark) * (np.arange(256) - 112.0) / (254.0 - 112.0)).clip(0, 255)
        assert np.array_equal(level_table(112.0, 254.0, model.looks[name], fixed=True), expected)
