"""Cameras exchanged while they are worn, and two that show one picture: found, kept as found, and never learnt from."""

from collections.abc import Mapping, Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regress.runtime.sample import Sample
from regress.runtime.stages.own_blinks import OwnBlinks
from tests.regress.test_own_blinks import lid, take
from track.profile.profile import Profile
from track.session.exchange import LATELY_S, CameraFault, ExchangeWatch, counted_pictures
from track.session.person import Person

FPS = 30
NAMES = ("left_eye", "right_eye", "mouth")
LONG = int(2 * LATELY_S * FPS)

PLACES = {
    name: np.random.default_rng(seed).integers(40, 220, (6, 6)).astype(np.uint8).repeat(8, 0).repeat(8, 1)
    for seed, name in enumerate(NAMES)
}
"""What is to be seen at each place, (48, 48): nothing of another's."""


def pictures(shown: Mapping[str, str], number: int) -> dict[str, np.ndarray]:
    """What cameras give that show these places; the noise is the sensor's, so that two of one place have the same."""
    rng = np.random.default_rng(number)
    of_place = {
        name: np.clip(place + rng.normal(0, 3.0, place.shape), 0, 255).astype(np.uint8)
        for name, place in PLACES.items()
    }
    return {camera: of_place[place] for camera, place in shown.items()}


RIGHT = {name: name for name in NAMES}
CROSSED = {"left_eye": "right_eye", "right_eye": "left_eye", "mouth": "mouth"}
TWICE = {**RIGHT, "right_eye": "left_eye"}


def without(shown: Mapping[str, str], *away: str) -> dict[str, str]:
    return {camera: place for camera, place in shown.items() if camera not in away}


def watched(*stretches: tuple[Mapping[str, str], int]) -> list[Sample]:
    """What the watch leaves of frames that show these places, for so many frames each."""
    watch, found = ExchangeWatch(), []
    for shown, count in stretches:
        for _ in range(count):
            number = len(found)
            found.append(watch.step(Sample(time_s=number / FPS, pictures=pictures(shown, number))))
    return found


def wrong(sample: Sample) -> set[str]:
    """Cameras that are told of."""
    return {name for name, fault in sample.faults.items() if isinstance(fault, CameraFault)}


@settings(deadline=None)
@given(st.lists(st.sampled_from([(), ("left_eye",), ("right_eye",), ("mouth",)]), min_size=1, max_size=8))
def test_eyes_found_exchanged_stay_so_whichever_is_away_until_both_are_right(away: Sequence[tuple[str, ...]]):
    """One of them that was learnt while the other was away was its own picture from then on."""
    gone = [(without(CROSSED, *names), LONG) for names in away]
    found = watched((RIGHT, LONG), (CROSSED, 1), *gone, (RIGHT, 1))
    for sample in found[LONG:-1]:
        assert not {"left_eye", "right_eye"} & set(sample.pictures)
    assert not found[-1].faults
    assert set(found[-1].pictures) == set(NAMES)


def test_one_that_looks_like_itself_again_is_not_held_back_for_one_that_stays_away():
    found = watched((RIGHT, LONG), (CROSSED, LONG), (without(RIGHT, "right_eye"), 2))
    assert set(found[-1].pictures) == {"left_eye", "mouth"}
    assert not found[-1].faults


@pytest.mark.parametrize("exchanged", [["left_eye", "right_eye"], ["left_eye", "mouth"], list(NAMES)])
def test_cameras_in_each_other_s_place_are_found_at_once_and_no_other_is(exchanged: list[str]):
    shown = {**RIGHT, **dict(zip(exchanged, exchanged[1:] + exchanged[:1], strict=True))}
    for sample in watched((RIGHT, LONG), (shown, LONG))[LONG:]:
        assert wrong(sample) == set(exchanged)
        assert set(sample.pictures) == set(NAMES) - set(exchanged)


def test_a_camera_that_shows_another_s_picture_is_left_out_and_both_are_told():
    found = watched((RIGHT, LONG), (TWICE, 3 * LONG), (RIGHT, LONG))
    late = found[2 * LONG : 4 * LONG]
    assert {fault for sample in late for fault in sample.faults.values()} == {CameraFault.SAME}
    assert {frozenset(wrong(sample)) for sample in late} == {frozenset({"left_eye", "right_eye"})}
    assert {frozenset(sample.pictures) for sample in late} == {frozenset({"left_eye", "mouth"})}
    assert {frozenset(counted_pictures(sample)) for sample in late} == {frozenset({"mouth"})}
    assert not found[-1].faults
    assert set(found[-1].pictures) == set(NAMES)


def test_of_one_picture_from_the_beginning_neither_camera_counts():
    late = watched((TWICE, 3 * LONG))[LONG:]
    assert {frozenset(wrong(sample)) for sample in late} == {frozenset({"left_eye", "right_eye"})}
    assert {frozenset(sample.pictures) for sample in late} == {frozenset({"mouth"})}


@pytest.mark.parametrize("shown", [RIGHT, TWICE])
def test_a_moment_of_one_picture_is_nothing_and_is_not_learnt(shown: Mapping[str, str]):
    """A blanket over both eyes, or a picture given late."""
    found = watched((RIGHT, LONG), (shown, int(0.8 * LATELY_S * FPS)), (CROSSED, 2))
    assert not any(sample.faults for sample in found[:-2])
    assert wrong(found[-1]) == {"left_eye", "right_eye"}


@pytest.mark.parametrize("unseen", [(False, False), (True, False), (False, True), (True, True)])
def test_no_blink_is_learnt_of_an_eye_that_no_camera_sees(unseen: tuple[bool, bool]):
    blinks = OwnBlinks()
    person = Person(Profile(person="a", camera="b"), mirrored=False, blinks=blinks)
    for sample in take(lid([0.5] * 14)):
        person.step(sample, unseen=unseen)
    assert [ends.full == 1.0 for ends in blinks.ends] == list(unseen)
