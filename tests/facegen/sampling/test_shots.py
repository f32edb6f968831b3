"""Shots: shares as the spec says, rooms by session, nothing where it is switched off."""

from dataclasses import replace

import numpy as np
import pytest

from facegen.sampling import draw_shot
from facegen.sampling.shots import DRAWN_ROOMS, ROOMS
from facegen.spec import parse_spec

LEDS = ("a", "b", "c")


def spec_of(**sensor):
    table = {"version": 1, "kind": "still", "seed": 4, "people": 9, "sensor": sensor}
    return parse_spec(table, where="here")


def shots_of(spec, count=600, view="left_eye"):
    return [draw_shot(spec, view, LEDS, session=i, sample=i) for i in range(count)]


def test_shares_and_spreads_are_the_specs():
    shots = shots_of(spec_of(flash=0.2, dropped_led=0.3, exposure_percent=4.0, motion_deg_s=30.0))
    assert np.mean([shot.flash for shot in shots]) == pytest.approx(0.2, abs=0.05)
    dropped = [shot.dropped_led for shot in shots if shot.dropped_led]
    assert len(dropped) / len(shots) == pytest.approx(0.3, abs=0.06)
    assert {*dropped} == {*LEDS}
    assert np.log([shot.exposure_factor for shot in shots]).std() == pytest.approx(0.04, rel=0.1)
    assert np.degrees([shot.motion_rad_s for shot in shots]).std() == pytest.approx(30.0, rel=0.1)
    assert np.allclose(np.linalg.norm([shot.room_direction for shot in shots], axis=-1), 1.0)
    for room in DRAWN_ROOMS:
        there = [shot.room_radiance for shot in shots if shot.room == room and not shot.flash]
        assert len(there) > 120
        assert max(there) <= ROOMS[room][1]


def test_a_spec_switches_all_of_it_off():
    off = {"exposure_percent": 0, "motion_deg_s": 0, "room": "dark", "flash": 0, "dropped_led": 0, "noise": 0}
    for shot in shots_of(spec_of(**off), 40):
        assert (shot.exposure_factor, shot.motion_rad_s, shot.noise) == (1.0, (0.0, 0.0), 0.0)
        assert (shot.room_radiance, shot.flash, shot.dropped_led) == (0.0, False, None)


def test_a_session_has_one_room_and_every_view_its_own_noise():
    spec = spec_of(room="bright_office", flash=0.0)
    a, b = (draw_shot(spec, view, LEDS, session=7, sample=70) for view in ("left_eye", "mouth"))
    later = draw_shot(spec, "mouth", LEDS, session=7, sample=71)
    assert (a.room_radiance, a.room_direction) == (b.room_radiance, b.room_direction)
    assert later.room_radiance == b.room_radiance
    assert len({shot.noise_seed for shot in (a, b, later)}) == 3


def test_a_screen_flashes():
    spec = spec_of(room="flashing_screen", flash=0.0)
    levels = {round(draw_shot(spec, "mouth", LEDS, session=3, sample=i).room_radiance, 9) for i in range(20)}
    dark, bright = sorted(levels)
    assert bright == pytest.approx(10 * dark)


def test_rooms_of_sequences_go_with_the_pupils():
    spec = spec_of()
    sequence = replace(spec.sequence, sessions=5, rooms=3)
    spec = replace(spec, kind="sequence", sequence=sequence)
    rooms = [draw_shot(spec, "mouth", LEDS, session=s, sample=0).room for s in range(5, 10)]
    assert rooms == [*DRAWN_ROOMS, *DRAWN_ROOMS[:2]]


def test_another_switch_leaves_the_other_draws():
    a, b = (shots_of(spec_of(flash=share), 30) for share in (0.0, 1.0))
    assert [shot.noise_seed for shot in a] == [shot.noise_seed for shot in b]
    assert [shot.motion_rad_s for shot in a] == [shot.motion_rad_s for shot in b]
