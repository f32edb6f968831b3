"""Training rows of a known detector: as far beside the truth as its table says, and in the parts that it says."""

import json
from dataclasses import asdict, replace

import numpy as np
import pytest

from facegen.conventions import LANDMARK_GROUPS
from regress.learning.training import RECIPES
from regress.learning.training.detectors import detectors, for_detector, noise_of
from regress.learning.training.noise import draw_displacements

MEAN_PERCENT = {
    "jaw": 8.5,
    "left_brow": 5.9,
    "nose_base": 3.9,
    "right_eye": 2.3,
    "outer_lip": 3.6,
    "inner_lip": 3.0,
}
"""Mean distances of MediaPipe's points from dlib's."""


@pytest.mark.parametrize("name", detectors())
def test_parts_add_up_and_pass_as_measured(name: str):
    recipe = for_detector(RECIPES["default"], name)
    noise = replace(recipe.calibrated_noise, jitter=0.0, jitter_most=None)
    frame, neutral = draw_displacements(noise, np.random.default_rng(0), 4000)
    for group, numbers in LANDMARK_GROUPS.items():
        rms = np.sqrt(np.square(frame[:, list(numbers)]).sum(axis=2).mean())
        apart = np.sqrt(np.square((frame - neutral)[:, list(numbers)]).sum(axis=2).mean() / 2)
        about = detectors()[name]
        assert rms == pytest.approx(np.hypot(about.staying[group], about.passing[group]), rel=0.03), group
        assert apart == pytest.approx(about.passing[group], rel=0.03), group


def test_mediapipe_is_as_far_from_dlib_as_was_measured():
    about = detectors()["mediapipe"]
    for group, percent in MEAN_PERCENT.items():
        mean = np.hypot(about.staying[group], about.passing[group]) * np.sqrt(np.pi) / 2
        assert 100 * mean == pytest.approx(percent), group


def test_the_jitter_of_the_recipe_stays_and_others_are_as_they_were():
    default = RECIPES["default"]
    known = for_detector(default, "mediapipe")
    assert known.calibrated_noise.jitter_most == default.calibrated_noise.jitter_most
    assert known.noise.clean == default.noise.clean
    assert replace(known, noise=default.noise, calibrated_noise=default.calibrated_noise) == default


def test_a_record_tells_of_the_noise_again():
    default = RECIPES["default"]
    for noise in (default.noise, for_detector(default, "mediapipe").calibrated_noise):
        assert noise_of(json.loads(json.dumps(asdict(noise)))) == noise


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--detector", "lens"], "--detector is 'lens', but must be one of mediapipe"),
        (
            ["--detector", "mediapipe", "--recipe", "paper"],
            "needs a recipe that learns from displaced points, and 'paper'",
        ),
    ],
)
def test_what_cannot_be_is_said_before_the_data_is_read(run, tmp_path, words: list[str], complaint: str):
    code, _, complaints = run("train", tmp_path / "nowhere", "--out", tmp_path / "model", *words)
    assert code == 2
    assert complaint in complaints
    assert "nowhere" not in complaints
