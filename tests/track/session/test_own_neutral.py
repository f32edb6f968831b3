"""A neutral face that `--neutral auto` finds: the profile has it from then on, as if it had been calibrated."""

from dataclasses import replace

import numpy as np
import pytest

from facegen.conventions import BLINK_INDICES
from regress.runtime.sample import Sample
from regress.runtime.stages.networks import FORGOTTEN_S, SURE_FROM_S
from regress.runtime.stages.own_blinks import Ends
from tests.regress.test_own_blinks import FPS, lid, take
from tests.track.session.faces import calibrated_profile, frames, new_session, talking_face
from track.profile.profile import Profile
from track.session.calibration import Outcome
from track.session.session import Session

PROFILE = Profile(person="anna", camera="camera 0")
JAW = Outcome(name="jaw_open", samples=tuple(frames(0, 1)), ranges={"jawOpen": 0.6})
ENDS = Ends(open=0.1, full=0.5)


class Sitting:
    """A person who rests before a session with `--neutral auto`."""

    def __init__(
        self, *, file: Profile = PROFILE, profile: Profile = PROFILE, keep_found: bool = True
    ) -> None:
        self.kept: list[Profile] = []
        self.said: list[str] = []
        self.session: Session = new_session(
            auto=True,
            said=self.said,
            profile=profile,
            kept=file,
            keep=self.kept.append,
            keep_found=keep_found,
        )
        self._row = 0

    def rest(self, seconds: float, *, away: bool = False) -> None:
        """Rest, or be away, for so long."""
        still = frames(0, 60)
        for _ in range(round(seconds * 30)):
            sample = replace(still[self._row % 60], time_s=self._row / 30)
            points = np.full((68, 2), np.nan) if away else sample.points
            self.session.answer(replace(sample, points=points))
            self._row += 1


def test_what_auto_finds_is_the_profile_s_neutral_face():
    sitting = Sitting()
    sitting.rest(SURE_FROM_S - 0.2)
    assert sitting.session.profile.neutral is None
    sitting.rest(0.4)
    neutral = sitting.session.profile.neutral
    assert [profile.neutral for profile in sitting.kept] == [neutral]
    assert sitting.kept[0].model == sitting.session.pipeline.mark
    rest = np.median(talking_face().points[:60], axis=0)
    across = np.ptp(rest[:, 0])
    np.testing.assert_allclose(np.median(neutral.frames("points"), axis=0), rest, atol=0.02 * across)
    assert neutral.irises is neutral.heads is None  # nobody was asked to look anywhere
    new_session(profile=sitting.kept[0])  # the next day it is used


def test_what_is_read_beside_it_is_kept_and_what_was_read_without_it_is_not():
    """A range of weights that were compared with nothing says nothing of weights that are compared with a face."""
    blinks = {"eyeBlinkLeft": ENDS, "eyeBlinkRight": ENDS}
    sitting = Sitting(profile=PROFILE.model_copy(update={"ranges": {"cheekPuff": 0.3}, "blinks": blinks}))
    sitting.rest(SURE_FROM_S + 0.2)
    assert (sitting.session.profile.ranges, sitting.session.profile.blinks) == ({}, {})
    sitting.session.adjusting.take(JAW)
    assert sitting.kept[-1].ranges == {"jawOpen": 0.6}
    assert sitting.kept[-1].neutral == sitting.session.profile.neutral is not None
    first = sitting.session.profile.neutral
    sitting.rest(10)  # another one is found
    assert sitting.session.profile.neutral != first
    assert sitting.kept[-1].neutral == sitting.session.profile.neutral
    assert sitting.kept[-1].ranges == {"jawOpen": 0.6}


def test_blinks_before_it_are_forgotten():
    sitting = Sitting()
    session = new_session(auto=True, own_blinks=True)
    person = session.adjusting.person
    blinks = take(lid([0.5] * 14))
    for sample in blinks:
        person.step(sample)
    few = blinks[: 4 * FPS]
    assert _highest(person, few) == pytest.approx(1.0)
    sitting.session = session
    sitting.rest(SURE_FROM_S + 0.2)
    assert _highest(person, few) == pytest.approx(0.5, abs=0.01)


def _highest(person, samples: list[Sample]) -> float:
    return max(person.step(sample).weights[BLINK_INDICES[0]] for sample in samples)


def test_a_neutral_face_that_the_file_has_stays():
    file = calibrated_profile()
    sitting = Sitting(file=file)
    sitting.rest(SURE_FROM_S + 0.2)
    assert sitting.session.profile.neutral not in (None, file.neutral)
    sitting.session.adjusting.take(JAW)
    assert sitting.kept == []
    assert "jaw_open is not kept: it was read without the neutral face of the profile" in sitting.said


def test_a_film_s_neutral_face_is_used_and_not_kept():
    """So its second run gives what its first one gave."""
    sitting = Sitting(keep_found=False)
    sitting.rest(SURE_FROM_S + 0.2)
    assert sitting.session.profile.neutral is not None
    assert sitting.kept == []


def test_a_face_that_was_away_is_compared_with_nothing_until_it_is_found_again():
    sitting = Sitting()
    sitting.rest(SURE_FROM_S + 0.2)
    found = sitting.kept[-1]
    sitting.rest(FORGOTTEN_S + 0.2, away=True)
    sitting.rest(0.2)
    assert sitting.session.profile.neutral is None
    sitting.session.adjusting.take(JAW)
    assert sitting.kept == [found]
    sitting.rest(SURE_FROM_S)
    assert sitting.kept[-1].neutral == sitting.session.profile.neutral != found.neutral


def test_who_calibrates_ends_the_looking():
    sitting = Sitting()
    sitting.rest(SURE_FROM_S + 0.2)
    sitting.session.adjusting.take(Outcome(name="neutral", samples=tuple(frames(0, 60))))
    calibrated = sitting.session.profile.neutral
    sitting.rest(25)
    assert sitting.session.profile.neutral == sitting.kept[-1].neutral == calibrated
