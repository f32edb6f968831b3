"""Blinks that nobody calibrated: what a profile knows goes before, and a person's own gains behind."""

from contextlib import ExitStack
from typing import ClassVar

import numpy as np
import pytest

from facegen.conventions import BLINK_INDICES
from regress.runtime.sample import Sample
from regress.runtime.stages.own_blinks import Ends, OwnBlinks
from tests.regress.test_own_blinks import FPS, lid, take
from tests.track.session.faces import Kept, frames, new_session
from track.cli import running
from track.cli.opening import Wishes
from track.profile.neutral import NeutralFace
from track.profile.profile import ModelMark, Profile, read_profile
from track.session.calibration import Outcome
from track.session.person import Person

PROFILE = Profile(person="anna", camera="0")
HALF = take(lid([0.5] * 14))
"""Fourteen blinks of an eye that reads half of what it does."""
LATE = slice(-4 * FPS, None)


def shown(person: Person, samples: list[Sample] = HALF) -> np.ndarray:
    """Highest weights (2,) of the last blinks."""
    return np.array([person.step(sample).weights[BLINK_INDICES] for sample in samples])[LATE].max(axis=0)


def test_own_blinks_shut_the_eyes():
    np.testing.assert_allclose(shown(Person(PROFILE, mirrored=False)), 0.5)
    np.testing.assert_allclose(shown(Person(PROFILE, mirrored=False, blinks=OwnBlinks())), 1.0)


def test_a_calibrated_range_goes_before():
    """It was read of eyes that were held shut; and no blink is stretched twice."""
    profile = PROFILE.model_copy(update={"ranges": {"eyeBlinkLeft": 0.8}})
    found = shown(Person(profile, mirrored=False, blinks=OwnBlinks()))
    np.testing.assert_allclose(found, [0.5 / 0.8, 1.0])


def test_a_range_that_comes_later_goes_before_too():
    person = Person(PROFILE, mirrored=False, blinks=OwnBlinks())
    shown(person)
    person.use(PROFILE.model_copy(update={"ranges": {"eyeBlinkLeft": 0.8, "eyeBlinkRight": 0.8}}))
    np.testing.assert_allclose(shown(person), 0.5 / 0.8)


def test_a_person_s_own_gain_is_kept():
    """Who wants an avatar that never shuts its eyes whole has it."""
    profile = PROFILE.model_copy(update={"gains": {"eyeBlinkLeft": 0.6, "eyeBlinkRight": 1.0}})
    np.testing.assert_allclose(shown(Person(profile, mirrored=False, blinks=OwnBlinks())), [0.6, 1.0])


def test_another_neutral_face_begins_anew_and_a_gain_does_not():
    person = Person(PROFILE, mirrored=False, blinks=OwnBlinks())
    shown(person)
    few = HALF[: 4 * FPS]
    changed = PROFILE.model_copy(update={"gains": {"jawOpen": 2.0}})
    person.use(changed)
    np.testing.assert_allclose(shown(person, few), 1.0)
    person.use(changed.model_copy(update={"neutral": NeutralFace(pictures={"left_eye": "AAAA"})}))
    np.testing.assert_allclose(shown(person, few), 0.5)


@pytest.mark.parametrize("own_blinks", [False, True])
def test_a_session_says_what_it_found(own_blinks: bool):
    """Through the whole session: what is kept of a person is read before anything is stretched."""
    said: list[str] = []
    session = new_session(said=said, own_blinks=own_blinks)
    session.pipeline.stages = {}
    for sample in HALF:
        session.answer(sample)
    sink = next(each for each in session.sinks if isinstance(each, Kept))
    assert sink.weights[LATE, BLINK_INDICES[0]].max() == pytest.approx(1.0 if own_blinks else 0.5)
    assert any("fullest blinks read 0.50" in line for line in said) is own_blinks


FEW = HALF[: 4 * FPS]
"""Too few blinks to tell anything by."""


def before_a_camera(profile: Profile = PROFILE, samples: list[Sample] = HALF, **wishes: object):
    """What a session shows of its last blinks, and each profile that it keeps."""
    kept: list[Profile] = []
    session = new_session(profile=profile, own_blinks=True, keep=kept.append, **wishes)
    session.pipeline.stages = {}
    for sample in samples:
        session.answer(sample)
    (sink,) = session.sinks
    assert isinstance(sink, Kept)
    return sink.weights[LATE, BLINK_INDICES[0]].max(), kept


def test_the_next_day_begins_with_them():
    _, kept = before_a_camera(keep_found=True)
    assert len(kept) == 1, "a file is written when something has changed, and not at each blink"
    assert kept[0].blinks["eyeBlinkLeft"].full == pytest.approx(0.5)
    assert kept[0].model == new_session().pipeline.mark
    assert kept[0].model_copy(update={"blinks": {}, "model": None}) == PROFILE
    shown_few, again = before_a_camera(kept[0], FEW, keep_found=True)
    assert shown_few == pytest.approx(1.0)
    assert again == []
    assert before_a_camera(samples=FEW)[0] == pytest.approx(0.5)


def test_today_s_go_before_those_of_another_day():
    """A cap pulled lower, another seat: eight blinks of today say more than all of last week's."""
    old = Ends(open=0.1, full=0.9)
    _, kept = before_a_camera(
        PROFILE.model_copy(update={"blinks": {"eyeBlinkLeft": old, "eyeBlinkRight": old}}), keep_found=True
    )
    assert [profile.blinks["eyeBlinkLeft"].full for profile in kept] == [pytest.approx(0.5)]


def test_a_film_leaves_the_profile_as_it_is():
    """So its second run gives what its first one gave."""
    assert before_a_camera(keep_found=False)[1] == []


@pytest.mark.parametrize(
    "file",
    [
        PROFILE.model_copy(update={"neutral": NeutralFace(pictures={"left_eye": "AAAA"})}),
        PROFILE.model_copy(update={"model": ModelMark(kind="landmarks", sha256="0" * 64)}),
    ],
    ids=["neutral face", "model"],
)
def test_a_file_of_something_else_is_left_alone(file: Profile):
    assert before_a_camera(kept=file, keep_found=True)[1] == []


def test_another_neutral_face_forgets_what_was_known():
    """Its answers are read beside another face."""
    ends = Ends(open=0.1, full=0.5)
    profile = PROFILE.model_copy(update={"blinks": {"eyeBlinkLeft": ends, "eyeBlinkRight": ends}})
    session = new_session(profile=profile, own_blinks=True)
    np.testing.assert_allclose(shown(session.adjusting.person, FEW), 1.0)
    session.adjusting.take(Outcome(name="neutral", samples=frames(0, 60)))
    assert session.profile.blinks == {}
    np.testing.assert_allclose(shown(session.adjusting.person, FEW), 0.5)


class Cable:
    """A camera, or a film, that nobody reads."""

    keys: ClassVar = {"camera": "camera 0"}

    def __init__(self, *, endless: bool) -> None:
        self.endless = endless

    def close(self) -> None:
        pass


@pytest.mark.parametrize("endless", [False, True], ids=["film", "camera"])
def test_the_commands_keep_a_camera_s_blinks_alone(endless: bool, tmp_path, monkeypatch):
    monkeypatch.setattr(running, "open_cameras", lambda *_: Cable(endless=endless))
    wishes = Wishes(detector="points", profile=str(tmp_path / "anna.toml"))
    with ExitStack() as closing:
        session, _ = running.open_session(
            wishes, {"camera": "0"}, [], print, closing, options=running.RunOptions(), must_keep=False
        )
        session.pipeline.stages = {}
        for sample in HALF:
            session.answer(sample)
    assert (tmp_path / "anna.toml").exists() is endless
    if endless:
        assert read_profile(tmp_path / "anna.toml").blinks["eyeBlinkRight"].full == pytest.approx(0.5)
