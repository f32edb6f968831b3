"""The state machine of calibration: what is asked for, when, and what is made of it."""

import itertools

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX
from regress.runtime.sample import Sample
from tests.track.session.faces import frames, new_session
from track.errors import InputError
from track.messages import Command
from track.session.calibration import (
    COUNTDOWN_S,
    FEWEST_FRAMES,
    FIRST_COUNTDOWN_S,
    LONGEST_S,
    OTHERS_RECORDING_S,
    RECORDING_S,
    TOLD_S,
    TRIES,
    Calibration,
)
from track.session.faces import FACES, OF_ALL, faces_of
from track.session.steadiness import steadiness

FPS = 30
LEAST = 0.015


def act(calibration: Calibration, person, *, most_s: float = 120.0):
    """Run it with a person, who is told each step and shows (weights, signature); gives steps and outcomes."""
    steps, outcomes, frame, shown = [], [], 0, (np.zeros(52), np.zeros(4))
    while not calibration.finished:
        weights, signature = shown
        step = calibration.step(frame / FPS, Sample(time_s=frame / FPS, weights=weights), signature)
        steps.append(step)
        outcomes += calibration.outcomes()
        shown = person(step, frame)
        frame += 1
        assert frame / FPS < most_s
    return steps, outcomes


def obedient(step, frame):
    """A person who does what is asked for, with a little noise."""
    rng = np.random.default_rng(frame)
    weights = np.clip(rng.normal(0, 0.01, 52), 0, 1)
    for name in FACES[step.name].shapes:
        weights[BLENDSHAPE_INDEX[name]] = 0.7
    return weights, rng.normal(0, 0.002, 4)


def test_an_obedient_person_is_asked_for_each_face_once():
    steps, outcomes = act(Calibration(faces_of("all", tuple(FACES)), least=LEAST), obedient)
    assert [outcome.name for outcome in outcomes] == list(FACES)
    assert {step.state for step in steps} == {"countdown", "recording", "done"}
    assert outcomes[0].ranges is None
    assert len(outcomes[0].samples) == pytest.approx(RECORDING_S["neutral"] * FPS, abs=2)
    for outcome in outcomes[1:]:
        assert set(outcome.ranges) == set(FACES[outcome.name].shapes)
        assert all(reading == pytest.approx(0.7) for reading in outcome.ranges.values())
    expected_s = FIRST_COUNTDOWN_S + RECORDING_S["neutral"] + TOLD_S
    expected_s += (len(FACES) - 1) * (COUNTDOWN_S + OTHERS_RECORDING_S + TOLD_S)
    expected_s += RECORDING_S["look_around"] - OTHERS_RECORDING_S
    assert expected_s < 60
    assert len(steps) / FPS == pytest.approx(expected_s, abs=1.0)


def test_nothing_of_the_first_seconds_is_recorded():
    _, outcomes = act(Calibration(("neutral",), least=LEAST), obedient)
    assert outcomes[0].samples[0].time_s >= FIRST_COUNTDOWN_S


def test_the_countdown_runs_down():
    steps, _ = act(Calibration(("neutral",), least=LEAST), obedient)
    left = [step.seconds_left for step in steps if step.state == "countdown"]
    assert left[0] == FIRST_COUNTDOWN_S
    np.testing.assert_allclose(np.diff(left), -1 / FPS)


@pytest.mark.parametrize(
    ("person", "reason"),
    [
        (lambda step, frame: (np.zeros(52), np.full(4, frame * 0.002)), "You moved"),
        (lambda step, frame: (np.full(52, np.nan), None), "Your face was seen in 0 of"),
        (lambda step, frame: (np.zeros(52), np.zeros(4) if frame % 2 else None), "Your face was seen in"),
    ],
)
def test_a_poor_neutral_face_is_asked_for_again_and_never_kept(person, reason):
    steps, outcomes = act(Calibration(faces_of("all"), least=LEAST), person)
    again = [step for step in steps if step.state == "again"]
    assert again
    assert all(step.text.startswith(reason) for step in again)
    assert len({step.text for step in again if step.text.endswith("as it was")}) == 1
    assert outcomes == []
    assert steps[-1].state == "failed"
    assert {step.name for step in steps} == {"neutral"}  # without it no range means anything
    countdowns = sum(a.state == "again" and b.state == "countdown" for a, b in itertools.pairwise(steps))
    assert countdowns == TRIES - 1


def test_too_few_pictures_are_told_as_such():
    calibration = Calibration(("neutral",), least=LEAST)
    at_rest = Sample(time_s=0.0, weights=np.zeros(52))
    steps = [calibration.step(0.6 * row, at_rest, np.zeros(4)) for row in range(30)]
    (text,) = {step.text for step in steps if step.state == "again" and step.text.endswith("once more")}
    assert text.startswith("Only 10 pictures came in 6 seconds, and 12 are needed"), text
    assert calibration.outcomes() == []


@pytest.mark.parametrize("fps", [2.1, 3, 5, 7, 8.5])
@pytest.mark.parametrize("name", ["neutral", "smile"])
def test_slow_pictures_are_waited_for_and_the_person_is_told(fps, name):
    """Below eight a second a recording of fixed length could never succeed, however often it was tried."""
    calibration = Calibration((name,), least=LEAST)
    steps, weights = [], np.full(52, 0.7)
    while not calibration.finished:
        time_s = len(steps) / fps
        steps.append((time_s, calibration.step(time_s, Sample(time_s=time_s, weights=weights), np.zeros(4))))
    (outcome,) = calibration.outcomes()
    assert len(outcome.samples) in (FEWEST_FRAMES, FEWEST_FRAMES + 1, round(fps * RECORDING_S["neutral"]))
    recorded = [(time_s, step) for time_s, step in steps if step.state == "recording"]
    usual_s = RECORDING_S.get(name, OTHERS_RECORDING_S)
    assert any("a little longer" in step.text for _, step in recorded) == (fps * usual_s < FEWEST_FRAMES - 1)
    assert recorded[-1][0] - recorded[0][0] <= max(usual_s, FEWEST_FRAMES / fps)
    assert all(0 <= step.seconds_left <= LONGEST_S for _, step in steps)


def test_pictures_without_a_face_are_not_waited_for():
    calibration = Calibration(("neutral",), least=LEAST)
    unseen = Sample(time_s=0.0, weights=np.full(52, np.nan))
    recorded = 0
    for frame in range(round((FIRST_COUNTDOWN_S + LONGEST_S) * FPS)):
        step = calibration.step(frame / FPS, unseen, None)
        if step.state == "again":
            break
        recorded += step.state == "recording"
    assert recorded == pytest.approx(RECORDING_S["neutral"] * FPS, abs=2)


def test_a_face_that_is_not_seen_is_left_out_and_the_others_kept():
    def person(step, frame):
        weights, signature = obedient(step, frame)
        weights[BLENDSHAPE_INDEX["cheekPuff"]] = 0.0
        return weights, signature

    steps, outcomes = act(Calibration(faces_of("all"), least=LEAST), person)
    assert [outcome.name for outcome in outcomes] == [name for name in OF_ALL if name != "cheeks"]
    assert any("cheekPuff" in step.text for step in steps)
    assert steps[-1].state == "done"


def test_one_side_that_is_faint_keeps_its_range_as_it_was():
    def person(step, frame):
        weights, signature = obedient(step, frame)
        weights[BLENDSHAPE_INDEX["mouthSmileLeft"]] = 0.1
        return weights, signature

    _, outcomes = act(Calibration(("smile",), least=LEAST), person)
    assert set(outcomes[0].ranges) == {"mouthSmileRight"}


def test_cancelling_ends_it():
    calibration = Calibration(faces_of("all"), least=LEAST)
    calibration.step(0.0, Sample(time_s=0.0, weights=np.zeros(52)), np.zeros(4))
    assert calibration.cancel().state == "cancelled"
    assert calibration.finished


def test_a_face_that_there_is_not_is_refused():
    with pytest.raises(InputError, match=r"no face 'ears'.*neutral, jaw_open"):
        faces_of("ears")


@pytest.mark.parametrize("noise", [0.001, 0.003, 0.01])
def test_noise_alone_is_still_and_a_slow_drift_is_not(noise):
    rng = np.random.default_rng(1)
    held = rng.normal(0, noise, (60, 136))
    drift = held + np.linspace(0, 8 * max(noise, LEAST), 60)[:, None]
    assert steadiness(held, least=LEAST).still
    assert not steadiness(drift, least=LEAST).still


def test_a_blink_is_no_movement():
    rng = np.random.default_rng(2)
    values = rng.normal(0, 0.003, (60, 136))
    values[28:32, 80:90] += 0.06
    assert steadiness(values, least=LEAST).still


@pytest.mark.parametrize("fps", [2.2, 3.0, 3.9])
def test_a_camera_s_pauses_between_two_pictures_are_no_missed_faces(fps):
    """A capture gives samples without pictures there, thirty a second once the avatar goes to rest."""
    session = new_session()
    session.ask(Command(verb="calibrate", value="neutral"))
    time_s, last = 0.0, -1
    while session.adjusting.step is None or session.adjusting.calibrating:
        number = int(time_s * fps)
        if number > last:
            session.answer(frames(number % 60, number % 60 + 1, first_s=time_s)[0])
        else:
            session.answer(Sample(time_s=time_s, pictures={}))
        last, time_s = number, time_s + 1 / FPS
        assert time_s < 20
    assert session.adjusting.step.state == "done"
    assert session.profile.neutral is not None


def test_a_camera_that_gives_nothing_is_told_as_such():
    calibration = Calibration(("neutral",), least=LEAST)
    steps = [calibration.step(row / FPS, Sample(pictures={}), None) for row in range(12 * FPS)]
    assert {step.text for step in steps if step.state == "again"} == {
        "No picture came in 6 seconds; once more"
    }
