"""A profile that changes all the time is written without holding anybody up, and its last state is never lost."""

import threading
import time
from pathlib import Path

import numpy as np
import pytest

from track.errors import OutputError
from track.profile import keeper
from track.profile.keeper import ProfileKeeper
from track.profile.neutral import NeutralFace, lines_of
from track.profile.profile import Ends, Profile, read_profile, write_profile


def profile(gain: float) -> Profile:
    return Profile(person="anna", camera="camera 0", gains={"jawOpen": gain})


def test_a_slider_that_is_drawn_waits_for_no_disk_and_its_last_gain_is_written(tmp_path: Path, monkeypatch):
    begun, disk, gains = threading.Event(), threading.Event(), []

    def write(path: Path, given: Profile) -> None:
        begun.set()
        assert disk.wait(60)
        gains.append(given.gains["jawOpen"])

    monkeypatch.setattr(keeper, "write_profile", write)
    kept = ProfileKeeper(tmp_path / "anna.toml", pytest.fail, known=profile(1.0), pause_s=0.01)
    kept.keep(profile(0.5))
    assert begun.wait(60)
    for step in range(100):
        kept.keep(profile(step / 100))
    assert gains == []
    disk.set()
    kept.close()
    assert gains == [0.5, 0.99]


def test_what_changed_just_before_the_end_is_written(tmp_path: Path):
    path = tmp_path / "people" / "anna.toml"
    kept = ProfileKeeper(path, pytest.fail, known=profile(1.0), pause_s=60.0)
    kept.keep(profile(2.0))
    since_s = time.monotonic()
    kept.close()
    assert time.monotonic() - since_s < 30
    assert read_profile(path) == profile(2.0)


def test_nothing_that_changed_is_no_file(tmp_path: Path):
    ProfileKeeper(tmp_path / "anna.toml", pytest.fail, known=profile(1.0)).close()
    assert not list(tmp_path.iterdir())


def test_a_full_disk_is_told_once(tmp_path: Path, monkeypatch):
    def write(path: Path, given: Profile) -> None:
        raise OutputError(f"{path}: no space left")

    monkeypatch.setattr(keeper, "write_profile", write)
    told: list[str] = []
    kept = ProfileKeeper(tmp_path / "anna.toml", told.append, known=profile(1.5), pause_s=0.01)
    for gain in (1.0, 2.0, 3.0):
        kept.keep(profile(gain))
        time.sleep(0.05)
    kept.close()
    assert told == [f"{tmp_path / 'anna.toml'}: no space left; what is changed now is forgotten at the end"]


NEUTRAL, OTHER = (
    NeutralFace(detector="mediapipe", points=lines_of(np.full((1, 68, 2), place), places=2))
    for place in (1.0, 2.0)
)


def test_what_another_program_has_calibrated_meanwhile_stays(tmp_path: Path):
    """`track calibrate` in a second terminal, while a session reads blinks and somebody draws a slider."""
    path, told = tmp_path / "anna.toml", []
    first = profile(1.0).model_copy(update={"neutral": NEUTRAL, "ranges": {"jawOpen": 0.5}})
    write_profile(path, first)
    kept = ProfileKeeper(path, told.append, known=first, pause_s=0.01)
    anew = first.model_copy(update={"neutral": OTHER, "ranges": {"jawOpen": 0.7}})
    write_profile(path, anew)
    gains = {"gains": {"jawOpen": 2.0}, "mirror": True}
    now = first.model_copy(update={**gains, "blinks": {"eyeBlinkLeft": Ends(open=0.1, full=0.5)}})
    kept.keep(now)
    until_s = time.monotonic() + 60
    while read_profile(path) == anew:
        assert time.monotonic() < until_s
        time.sleep(0.01)
    assert read_profile(path) == anew.model_copy(update=gains)
    kept.keep(now.model_copy(update={"mirror": False}))
    kept.close()
    assert read_profile(path) == anew.model_copy(update={**gains, "mirror": False})
    assert told == [f"{path} was changed by another program; what it has changed stays"]


def test_a_profile_that_was_deleted_comes_back_with_a_calibration_alone(tmp_path: Path):
    path, told = tmp_path / "anna.toml", []
    write_profile(path, profile(1.0))
    kept = ProfileKeeper(path, told.append, known=profile(1.0), pause_s=0.01)
    path.unlink()
    kept.keep(profile(2.0))
    until_s = time.monotonic() + 60
    while not told:
        assert time.monotonic() < until_s
        time.sleep(0.01)
    assert told == [f"{path} was removed; what is changed now is forgotten at the end"]
    assert not path.exists()
    kept.keep(profile(2.0).model_copy(update={"neutral": NEUTRAL}))
    kept.close()
    assert read_profile(path) == profile(2.0).model_copy(update={"neutral": NEUTRAL})
