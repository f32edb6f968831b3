"""Calibration while cameras of a headset give nothing: of those that are there, and the missing ones are named."""

from collections.abc import Callable, Collection
from dataclasses import replace
from itertools import count

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.runtime.headset.network.parts import part_of
from regress.runtime.sample import Sample
from tests.track.session.test_calibration import act, obedient
from tests.track.session.test_chaos import FPS, HEADSET, headset_frames
from track.messages import Command
from track.profile.profile import Profile
from track.session.calibration import Calibration
from track.session.exchange import CameraFault as Exchange
from track.session.faces import FACES
from track.session.headset import HeadsetPipeline
from track.session.session import Session
from track.session.showing import FEWEST_FRAMES
from track.sources import CameraFault

LEAST = 0.015


def seen_by(cameras: Collection[str]) -> np.ndarray:
    """(52,) bool."""
    named = {name for camera in cameras for name in part_of(camera)}
    return np.array([name in named for name in BLENDSHAPES])


ALONE = {name: seen_by([name]) & ~seen_by(set(HEADSET) - {name}) for name in HEADSET}
"""Shapes that one camera alone sees."""


def shown_without(
    missing: Collection[str], faces: tuple[str, ...], *, at: Callable[[int], bool] = lambda row: True
):
    """Steps and outcomes of an obedient person, of whom these cameras give nothing in the frames that ``at`` says."""
    calibration = Calibration(faces, least=LEAST)
    steps, outcomes = [], []
    for row in count():
        weights, signature = obedient(steps[-1], row) if steps else (np.zeros(52), np.zeros(4))
        there = [name for name in HEADSET if name not in missing or not at(row)]
        seen = Sample(
            time_s=row / FPS,
            weights=np.where(seen_by(there), weights, np.nan),
            gaze=np.zeros(4) if {"left_eye", "right_eye"} & {*there} else np.full(4, np.nan),
            pictures={name: np.zeros((4, 4), np.uint8) for name in there},
            faults={name: CameraFault.SILENT for name in HEADSET if name not in there},
        )
        steps.append(calibration.step(seen.time_s, seen, signature))
        outcomes += calibration.outcomes()
        if calibration.finished:
            return steps, outcomes


@pytest.mark.parametrize("missing", [["mouth"], ["left_eye"], ["left_eye", "right_eye"]], ids=" and ".join)
def test_what_is_there_is_calibrated_and_the_missing_camera_is_named(missing: list[str]):
    steps, outcomes = shown_without(missing, tuple(FACES))
    seen = seen_by(set(HEADSET) - set(missing))
    expected = {
        name: {shape for shape in face.shapes if seen[BLENDSHAPE_INDEX[shape]]}
        for name, face in FACES.items()
    }
    known = {name for name in FACES if expected[name] or name == "neutral"}
    known |= set() if missing == ["left_eye", "right_eye"] else {"look_around"}
    assert [outcome.name for outcome in outcomes] == [name for name in FACES if name in known]
    assert all(set(outcome.ranges or ()) == expected[outcome.name] for outcome in outcomes)
    told = {(step.name, step.text) for step in steps if step.state == "again"}
    assert {name for name, _ in told} == set(FACES) - known
    for _, text in told:  # once: to show it again does not help
        assert (
            text == f"No camera sees it, as no picture of {', '.join(missing)} is of use; it stays as it was"
        )
    good = {step.text for step in steps[:-1] if step.state == "done"} - {"All done"}
    assert good == {f"Good, without {', '.join(missing)}"}


def test_a_camera_that_comes_and_goes_is_named_and_not_the_face():
    steps, outcomes = shown_without(["mouth"], ("neutral",), at=lambda row: row % 2 == 0)
    assert outcomes == []
    texts = {step.text for step in steps if step.state == "again"}
    assert texts
    assert all(text.startswith("mouth came and went") for text in texts)


def test_a_few_frames_without_a_camera_cost_these_frames_alone():
    _, (outcome,) = shown_without(["mouth"], ("neutral",), at=lambda row: row % 10 == 0)
    assert all(set(sample.pictures) == set(HEADSET) for sample in outcome.samples)
    assert len(outcome.samples) >= FEWEST_FRAMES


def test_a_face_that_is_not_there_is_told_as_such_beside_all_cameras():
    steps, _ = act(Calibration(("neutral",), least=LEAST), lambda step, frame: (np.full(52, np.nan), None))
    assert {step.text.split(" in ")[0] for step in steps if step.state == "again"} == {"Your face was seen"}


def new_session(said: list[str] | None = None, profile: Profile | None = None, **wishes: object) -> Session:
    pipeline = HeadsetPipeline("headset-tracking3", filter_name="none", **wishes)
    profile = profile or Profile(person="anna", camera="three")
    return Session(
        pipeline=pipeline, sinks=[], profile=profile, say=(said if said is not None else []).append
    )


def without(sample: Sample, missing: Collection[str], fault: CameraFault | Exchange) -> Sample:
    left = {name: picture for name, picture in sample.pictures.items() if name not in missing}
    return replace(sample, pictures=left, faults=dict.fromkeys(missing, fault))


def at_rest(session: Session, missing: Collection[str], seconds: float) -> np.ndarray:
    """Answers of the pipeline while a face rests."""
    answers = []
    for row in range(round(seconds * FPS)):
        time_s = at_rest.time_s = getattr(at_rest, "time_s", 0.0) + 1 / FPS
        sample = replace(headset_frames()[row % 10], time_s=time_s)
        answers += session.answer(without(sample, missing, CameraFault.UNPLUGGED))
    return np.array([answer.weights for answer in answers])


@pytest.mark.parametrize("missing", HEADSET)
def test_a_camera_without_a_neutral_picture_is_seen_alone_once_it_is_back(missing: str):
    said = []
    session, plain, whole = new_session(said), new_session(), new_session()
    for each, gone in ((session, [missing]), (whole, [])):
        each.ask(Command(verb="calibrate", value="neutral"))
        at_rest(each, gone, 7)
        assert not each.adjusting.calibrating
    assert set(session.profile.neutral.pictures) == set(HEADSET) - {missing}
    assert not {name for name in session.profile.rests if ALONE[missing][BLENDSHAPE_INDEX[name]]}
    told = f"{missing}: it gave no picture when your neutral face was taken"
    assert not any(line.startswith(told) for line in said)
    answers, uncalibrated, calibrated = (at_rest(each, [], 1.5)[FPS:] for each in (session, plain, whole))
    assert sum(line.startswith(told) for line in said) == 1
    own = ALONE[missing]
    np.testing.assert_allclose(answers[:, own], uncalibrated[:, own], atol=0.05)
    np.testing.assert_allclose(answers[:, ~own], calibrated[:, ~own], atol=0.1)
    again = new_session(profile=session.profile)  # the next day
    np.testing.assert_allclose(at_rest(again, [], 1.5)[FPS:], answers, atol=0.1)


def test_a_missing_camera_keeps_its_neutral_picture_and_its_rests():
    session = new_session()
    session.ask(Command(verb="calibrate", value="neutral"))
    at_rest(session, [], 7)
    before = session.profile
    session.ask(Command(verb="calibrate", value="neutral"))
    at_rest(session, ["mouth"], 7)
    assert session.profile.neutral != before.neutral
    assert session.profile.neutral.pictures["mouth"] == before.neutral.pictures["mouth"]
    for name in ("left_eye", "right_eye"):
        assert session.profile.neutral.pictures[name] != before.neutral.pictures[name]
    of_mouth = {name: rest for name, rest in before.rests.items() if ALONE["mouth"][BLENDSHAPE_INDEX[name]]}
    assert of_mouth
    assert of_mouth.items() <= session.profile.rests.items()


@pytest.mark.parametrize("fault", Exchange)
def test_pictures_of_a_camera_in_a_wrong_place_are_calibrated_by_no_face(fault: Exchange):
    pipeline = new_session().pipeline
    sample = headset_frames()[0]
    for stage in pipeline.stages.values():
        sample = stage.step(sample)
    given = pipeline.calibrated_by(replace(sample, faults={"left_eye": fault}))
    assert set(given.pictures) == {"right_eye", "mouth"}
    np.testing.assert_array_equal(np.isnan(given.weights), ALONE["left_eye"])
    np.testing.assert_array_equal(np.isnan(given.eyes.openness_mm), [True, False])


def test_only_faces_are_asked_for_that_a_camera_sees_which_is_there():
    faces = new_session(opened=["mouth"]).pipeline.faces
    assert {"neutral", "jaw_open", "smile"} < set(faces)
    assert not {"eyes_shut", "eyes_wide", "brows_up"} & set(faces)
    assert new_session().pipeline.faces == tuple(FACES)
