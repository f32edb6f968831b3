"""Levels of pictures: what lies in training's range stays, other pictures are brought there, live ones soon too."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.exporters.headset_interface import interface_of
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.headset.pictures.looks import (
    CameraLooks,
    flicker_of,
    levels_of,
    looks_of,
    rim_of,
    sharpness_of,
)
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.levels import (
    CameraLevels,
    Levels,
    brightness_of,
    levelled,
    levels_in,
    levels_of_cameras,
)
from regress.runtime.headset.recordings.footage import line_up
from tests.regress.headset.takes import HEIGHT, WIDTH, pictures, recording

LOOKS = CameraLooks(
    low=(12.0, 14.0, 16.0),
    high=(115.0, 143.0, 177.0),
    saturated=(0.0, 0.0, 0.001),
    sharpness=(0.1, 0.13, 0.17),
    rim=(0.0, 0.0, 0.0),
)
FACE = np.clip(
    90 + 40 * np.repeat(np.repeat(np.random.default_rng(3).standard_normal((24, 24)), 4, 0), 4, 1), 20, 240
)


def lit(times: float, grain: float = 0.0) -> np.ndarray:
    """One face (96, 96) in a light of so many times."""
    noise = np.random.default_rng(round(1000 * times)).standard_normal(FACE.shape)
    return np.rint(FACE * times + grain * noise).clip(0, 255).astype(np.uint8)


@given(st.floats(0.05, 2), st.floats(0.05, 4), st.floats(0.05, 1), st.floats(2, 60), st.booleans())
def test_levels_keep_their_order(low: float, apart: float, brightness: float, grey: float, fixed: bool):
    given = CameraLevels(low=low, high=low + apart, wanted_low=14, wanted_high=143, fixed=fixed)
    table = given.table(brightness * grey).astype(int)
    assert (np.diff(table) >= 0).all()
    assert np.diff(table).max() <= (143 - 14) / 8 + 1  # a flat picture is not stretched to noise


@given(st.floats(0.2, 1.0))
def test_a_picture_looks_the_same_in_any_light(times: float):
    bright, dim = lit(1.0), lit(times)
    levels = levels_in([np.stack([bright, dim])], LOOKS)
    step = 129 / (levels.high - levels.low) / 90 / times  # a grey level of the dimmer picture, and rounding
    assert np.abs(levels.apply(bright).astype(int) - levels.apply(dim)).max() <= step + 2


@given(st.floats(0.3, 1.0))
def test_ends_become_trainings_middle_ones(times: float):
    take = np.stack([lit(times, grain=1.0), lit(times)])
    low, high = levels_of(levels_in([take], LOOKS).apply(take))
    assert (low, high) == (pytest.approx(14, abs=4), pytest.approx(143, abs=4))


def test_all_of_a_take_counts_whatever_its_order():
    flat = np.rint(90 + 0.4 * (FACE - 90)).astype(np.uint8)
    take = np.stack([*[lit(1.0)] * 60, *[flat] * 60])
    found = levels_in([take], LOOKS)
    assert found.high == pytest.approx(levels_in([take[::-1]], LOOKS).high)
    assert found.high == pytest.approx(levels_in([take[:60], take[60:]], LOOKS).high)
    assert found.high > levels_in([take[60:]], LOOKS).high + 0.1


@pytest.mark.parametrize("share", [0.3, 0.45])
def test_a_dark_rim_leaves_the_brightness_alone(share: float):
    """Brightness is of what the lamps light, so that it still follows them where a lens circle cuts half away."""
    rows, columns = np.mgrid[:96, :96]
    apart = np.hypot(rows - 47.5, columns - 47.5)
    rim = apart > np.quantile(apart, 1 - share)
    counts = [
        np.bincount(np.where(rim, 4, lit(times)).ravel(), minlength=256).astype(float) for times in (1.0, 0.5)
    ]
    bright, dim = map(brightness_of, counts)
    assert dim / bright == pytest.approx(0.5, abs=0.03)


def test_a_picture_that_is_nearly_all_rim_is_not_whitened():
    counts = np.zeros(256)
    counts[2], counts[180] = 90, 10
    assert brightness_of(counts) >= 15


def take(means, **changes):
    made = recording("left_eye", pictures(means), **changes)
    return line_up({"left_eye": made}, {"left_eye": (WIDTH, HEIGHT), "mouth": (WIDTH, HEIGHT)})


def test_a_bright_take_is_levelled_and_pictures_at_fault_stay_black():
    footage = take(np.full(20, 200.0))
    found = levels_of_cameras(footage, {"left_eye": LOOKS, "mouth": LOOKS}, {})
    assert list(found) == ["left_eye"]
    low, high = levels_of(levelled(footage, found).pictures["left_eye"])
    assert (low, high) == (pytest.approx(14, abs=4), pytest.approx(143, abs=4))
    assert levels_of(footage.pictures["left_eye"])[0] > 150  # the take itself is left alone
    dark = replace(footage, faults={**footage.faults, "left_eye": (None,) * 19 + footage.faults["mouth"][:1]})
    assert (levelled(dark, found).pictures["left_eye"][:19] != footage.pictures["left_eye"][:19]).any()
    np.testing.assert_array_equal(
        levelled(dark, found).pictures["left_eye"][19], dark.pictures["left_eye"][19]
    )


def test_a_placements_levels_go_first():
    footage = take(np.full(20, 80.0))
    named = {"left_eye": CameraPlacement(low=60.0, high=100.0)}
    held = levels_of_cameras(footage, {"left_eye": LOOKS}, named)["left_eye"]
    assert (held.table()[60], held.table()[100]) == (14, 143)
    live = Levels({"left_eye": LOOKS}, named)
    picture = footage.pictures["left_eye"][0]
    np.testing.assert_array_equal(live.step(1 / 30, {"left_eye": picture})["left_eye"], held.table()[picture])
    np.testing.assert_array_equal(live.levelled({"left_eye": picture})["left_eye"], held.table()[picture])


def test_live_levels_become_those_of_the_take():
    stack = pictures(np.tile([190.0, 200, 210, 205], 100))
    footage = take(np.tile([190.0, 200, 210, 205], 100))
    expected = levels_of_cameras(footage, {"left_eye": LOOKS}, {})["left_eye"].apply(stack[-1])
    live = Levels({"left_eye": LOOKS})
    for picture in stack:
        seen = live.step(1 / 30, {"left_eye": picture, "mouth": picture})
    np.testing.assert_array_equal(seen["mouth"], stack[-1])  # of a camera that the model says nothing of
    assert np.abs(seen["left_eye"].astype(int) - expected).max() <= 6
    # neutral pictures and those of before get the same
    np.testing.assert_array_equal(live.levelled({"left_eye": stack[-1]})["left_eye"], seen["left_eye"])
    np.testing.assert_array_equal(live.levelled({"left_eye": stack[-2:]})["left_eye"][1], seen["left_eye"])


@pytest.mark.parametrize("fps", [15, 120])
@pytest.mark.parametrize("after", [0.3, 0.6, 1.2])
def test_a_lamp_that_changes_is_no_other_picture_in_the_same_frame(fps: int, after: float):
    """Ends of grey levels took 39 s to forget a bright lamp; what is measured beside the brightness stays."""
    live = Levels({"left_eye": LOOKS})
    for _ in range(5 * fps):
        before = live.step(1 / fps, {"left_eye": lit(1.0, grain=1)})["left_eye"]
    first = live.step(1 / fps, {"left_eye": lit(after, grain=1)})["left_eye"]
    assert np.abs(before.astype(int) - first).mean() < 5


def test_live_ends_follow_another_wearer():
    """Less contrast, as of another person's skin, is stretched as far before half a minute is over."""
    live = Levels({"left_eye": LOOKS})
    flat = np.rint(90 + 0.4 * (FACE - 90)).astype(np.uint8)
    for _ in range(300):
        live.step(1 / 15, {"left_eye": lit(1.0)})
    spans = [np.ptp(levels_of(live.step(1 / 15, {"left_eye": flat})["left_eye"])) for _ in range(600)]
    assert spans[0] < 70 < 110 < spans[-1]


def test_a_settled_neutral_picture_stays_the_same():
    """Else it would be encoded again with each frame, a third of a frame's time."""
    live, neutral = Levels({"left_eye": LOOKS}), lit(0.8)
    random = np.random.default_rng(0)
    shown = []
    for number in range(600):
        live.step(1 / 30, {"left_eye": lit(random.uniform(0.9, 1.1), grain=1)})
        if number > 300:
            shown.append(live.levelled({"left_eye": neutral})["left_eye"].tobytes())
    assert len(set(shown)) <= 2


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


def test_other_programs_know_what_levels_become():
    """By `levels.middle` of headset.json, as docs/your-camera.md has it: of the ranges' ends weights differ by .16."""
    model = load_headset_predictor("headset-tracking3").model
    for name, exported in interface_of(model, graph="g.onnx")["levels"].items():
        dark, bright = exported["middle"]
        expected = np.rint(dark + (bright - dark) * (np.arange(256) - 112.0) / (254.0 - 112.0)).clip(0, 255)
        held = levels_in([], model.looks[name], CameraPlacement(low=112.0, high=254.0))
        assert np.array_equal(held.table(), expected)
        picture = lit(0.6)
        ordered = np.sort(picture.ravel())
        brightness = ordered[len(ordered) // 2 : 3 * len(ordered) // 4].mean()
        own = levels_in([picture[None]], model.looks[name])
        p, q = np.percentile(picture / brightness, [2, 98])
        said = dark + (bright - dark) * (picture / brightness - p) / (q - p)
        assert np.abs(own.apply(picture) - np.rint(said).clip(0, 255)).max() <= 4
