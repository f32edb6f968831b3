"""Blinks that nobody calibrated: what a profile knows goes before, and a person's own gains behind."""

import numpy as np
import pytest

from regress.runtime.sample import Sample
from regress.runtime.stages.own_blinks import BLINKS, OwnBlinks
from tests.regress.test_own_blinks import FPS, lid, take
from tests.track.session.faces import Kept, new_session
from track.profile.neutral import NeutralFace
from track.profile.profile import Profile
from track.session.person import Person

PROFILE = Profile(person="anna", camera="0")
HALF = take(lid([0.5] * 14))
"""Fourteen blinks of an eye that reads half of what it does."""
LATE = slice(-4 * FPS, None)


def shown(person: Person, samples: list[Sample] = HALF) -> np.ndarray:
    """Highest weights (2,) of the last blinks."""
    return np.array([person.step(sample).weights[BLINKS] for sample in samples])[LATE].max(axis=0)


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
    assert sink.weights[LATE, BLINKS[0]].max() == pytest.approx(1.0 if own_blinks else 0.5)
    assert any("fullest blinks read 0.50" in line for line in said) is own_blinks
