"""What eyes say at a target: of a moment, for one frame may be of a blink or of a look elsewhere."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.cli.headset_input import read_footage
from regress.runtime.headset.eyes.glances import glances
from regress.runtime.headset.eyes.own_gaze import own_gaze
from regress.runtime.headset.guided.minute import GuidedTake, person_of
from regress.runtime.headset.network.predictor import load_headset_predictor

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
AT, SHUT_GAZE = 20, np.array([2.0, -30.0])
field = st.floats(-20, 20)


def still(yaw: float, pitch: float, fps: float = 30.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """An answer (n, 2), openness and times of an eye that looks at one thing."""
    count = 2 * AT + 1
    return np.tile([yaw, pitch], (count, 1)), np.full(count, 0.9), np.arange(count) / fps


@given(field, field, st.integers(-2, 2))
def test_a_blink_at_the_frame_says_what_was_looked_at_about_it(yaw: float, pitch: float, late: int):
    answer, openness, time_s = still(yaw, pitch)
    lids = slice(AT + late - 2, AT + late + 3)
    answer[lids], openness[lids] = SHUT_GAZE, 0.15
    for number, found in enumerate(glances([answer, answer + 1], openness, time_s, [AT])):
        np.testing.assert_allclose(found[0], [yaw + number, pitch + number])


@given(field, field, st.sampled_from([30.0, 90.0, 200.0]))
def test_an_eye_that_is_shut_for_the_moment_says_nothing_at_any_frame_rate(
    yaw: float, pitch: float, fps: float
):
    answer, openness, time_s = still(yaw, pitch, fps)
    near = np.abs(time_s - time_s[AT]) < 0.2
    openness[near] = 0.15
    assert np.isnan(glances([answer], openness, time_s, [AT])[0]).all()
    answer[AT] = np.nan
    openness[:] = 0.9
    np.testing.assert_allclose(glances([answer], openness, time_s, [AT])[0], [[yaw, pitch]])


@given(field, field, st.floats(4, 40))
def test_frames_of_another_look_do_not_count(yaw: float, pitch: float, way: float):
    answer, openness, time_s = still(yaw, pitch)
    answer[AT + 1 :, 0] += way
    answer[: AT - 1, 1] -= way
    np.testing.assert_allclose(glances([answer], openness, time_s, [AT])[0], [[yaw, pitch]])
    # one frame a target, and an eye that was shut at the second: nothing is taken from its neighbours
    openness[AT] = 0.1
    found = glances([answer], openness, time_s, [AT - 1, AT, AT + 1])[0]
    assert np.isnan(found[1]).all()
    np.testing.assert_allclose(found[[0, 2]], answer[[AT - 1, AT + 1]])


def test_eyes_that_look_down_are_not_taken_for_shut():
    answer, openness, time_s = still(0.0, -20.0)
    openness[:] = 0.35
    np.testing.assert_allclose(glances([answer], openness, time_s, [AT])[0], [[0.0, -20.0]])


@pytest.mark.parametrize("count", [6, 9])
def test_a_target_that_was_not_looked_at_is_left_out_and_named(count: int):
    rng = np.random.default_rng(count)
    spoilt, clean = [], []
    for wrong in range(count):
        targets, others = rng.uniform(-20, 20, (2, count, 2))
        looked = targets + rng.normal(0, 0.7, targets.shape)
        missed = looked.copy()
        missed[wrong] += [0, -25]
        own = own_gaze([missed], targets)
        assert wrong in own.missed_deg
        assert 10 < own.missed_deg[wrong] < 45
        assert count - len(own.missed_deg) >= 5
        spoilt.append(np.linalg.norm(own.apply([others]) - others, axis=1).mean())
        clean.append(np.linalg.norm(own_gaze([looked], targets).apply([others]) - others, axis=1).mean())
    assert np.mean(spoilt) < 1.5 * np.mean(clean) + 0.1


def test_five_targets_are_all_kept():
    rng = np.random.default_rng(0)
    targets = rng.uniform(-20, 20, (5, 2))
    looked = targets.copy()
    looked[2] += [0, -25]
    assert not own_gaze([looked], targets).missed_deg


def test_shut_frames_in_a_look_leave_the_gaze_as_it_was():
    predictor = load_headset_predictor("headset-tracking3")
    given = {name: TAKE / name for name in ("left_eye", "right_eye", "mouth")}
    pictures = read_footage(predictor, None, given, from_start=False, fps=None).pictures
    rest = GuidedTake(pictures={name: frames[:10] for name, frames in pictures.items()}, targets_deg={})
    # each look lasts a third of a second, as people look
    rows = np.repeat(np.arange(0, 72, 8), 10)
    looks = {name: frames[rows] for name, frames in pictures.items()}
    wanted = np.degrees(predictor.predict(looks).gaze.mean(axis=1))
    targets = {row: tuple(wanted[row]) for row in range(5, len(rows), 10)}

    def calibrated(shut: range) -> tuple[np.ndarray, tuple[str, ...]]:
        seen = {name: frames.copy() for name, frames in looks.items()}
        for name, frames in seen.items():
            frames[shut.start : shut.stop] = pictures[name][91]
        take = GuidedTake(pictures=seen, targets_deg=targets)
        person, notes = person_of(predictor, {"rest": rest, "look": take})
        return np.array([[eye.traced, eye.direct] for eye in person.eyes.values()]), notes

    plain, known = calibrated(range(0))
    blinked, _ = calibrated(range(44, 47))
    # of 20 degrees, to the tenth of one
    np.testing.assert_allclose(blinked[..., :2], plain[..., :2], atol=0.005)
    np.testing.assert_allclose(blinked[..., 2], plain[..., 2], atol=0.1)
    _, notes = calibrated(range(40, 50))
    told = set(notes) - set(known)
    yaw, pitch = targets[45]
    assert len(told) == 2
    assert all(f"{yaw:g}:{pitch:g}" in note and "left out" in note for note in told)
