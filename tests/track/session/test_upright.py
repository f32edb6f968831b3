"""Eyes that are exchanged, turned or in a mirror from the first picture on are told while the headset is worn."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from regress.runtime.sample import Sample
from tests.track.session.test_chaos import FPS, headset_frames, headset_session
from track.session.upright import EVERY_S, FEWEST, UprightWatch

Pictures = dict[str, np.ndarray]

ENOUGH = round((FEWEST + 2) * EVERY_S * FPS)


def exchanged(pictures: Pictures) -> Pictures:
    return pictures | {"left_eye": pictures["right_eye"], "right_eye": pictures["left_eye"]}


def upside_down(pictures: Pictures) -> Pictures:
    return pictures | {"right_eye": np.ascontiguousarray(pictures["right_eye"][::-1, ::-1])}


def frames(change: Callable[[Pictures], Pictures] = dict) -> list[Sample]:
    return [replace(one, pictures=change(dict(one.pictures))) for one in headset_frames()[:ENOUGH]]


def test_nothing_is_said_of_eyes_upright_and_every_picture_is_left():
    watch = UprightWatch(("left_eye", "right_eye", "mouth"))
    for sample in frames():
        assert watch.step(sample) is sample
    assert watch.told == {}


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (
            exchanged,
            {
                "left_eye": "those of right_eye or of an eye in a mirror than like a left eye upright",
                "right_eye": "those of left_eye or of an eye in a mirror than like a right eye upright",
            },
        ),
        (upside_down, {"right_eye": "those of an eye upside down than like a right eye upright"}),
    ],
)
def test_what_is_wrong_from_the_beginning_is_told_once_by_a_session(
    change: Callable[[Pictures], Pictures], told: dict[str, str]
):
    said: list[str] = []
    session = headset_session(said)
    for sample in frames(change):
        session.answer(sample)
    lines = {line.split(":")[0]: line for line in said if "look more like" in line}
    assert len([line for line in said if "look more like" in line]) == len(lines)
    assert set(lines) == set(told)
    assert all(words in lines[name] for name, words in told.items())


def test_what_was_made_good_is_told_no_more():
    watch = UprightWatch(("left_eye", "right_eye", "mouth"))
    for sample in frames(exchanged):
        watch.step(sample)
    assert set(watch.told) == {"left_eye", "right_eye"}
    later_s = frames()[-1].time_s + 1
    for turn in range(4):
        for sample in frames():
            watch.step(replace(sample, time_s=sample.time_s + later_s * (1 + turn)))
    assert watch.told == {}


def test_a_time_that_runs_back_and_cameras_without_pictures_stop_nothing():
    watch = UprightWatch(("left_eye", "mouth"))
    for time_s in (5.0, 1.0, 1.5):
        watch.step(Sample(time_s=time_s, pictures={}))
        watch.step(Sample(time_s=time_s, pictures=None))
    assert watch.told == {}
