"""A profile that changes all the time is written without holding anybody up, and its last state is never lost."""

import threading
import time
from pathlib import Path

import pytest

from track.errors import OutputError
from track.profile import keeper
from track.profile.keeper import ProfileKeeper
from track.profile.profile import Profile, read_profile


def profile(gain: float) -> Profile:
    return Profile(person="anna", camera="camera 0", gains={"jawOpen": gain})


def test_a_slider_that_is_drawn_waits_for_no_disk_and_its_last_gain_is_written(tmp_path: Path, monkeypatch):
    begun, disk, gains = threading.Event(), threading.Event(), []

    def write(path: Path, given: Profile) -> None:
        begun.set()
        assert disk.wait(60)
        gains.append(given.gains["jawOpen"])

    monkeypatch.setattr(keeper, "write_profile", write)
    kept = ProfileKeeper(tmp_path / "anna.toml", pytest.fail, pause_s=0.01)
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
    kept = ProfileKeeper(path, pytest.fail, pause_s=60.0)
    kept.keep(profile(2.0))
    since_s = time.monotonic()
    kept.close()
    assert time.monotonic() - since_s < 30
    assert read_profile(path) == profile(2.0)


def test_nothing_that_changed_is_no_file(tmp_path: Path):
    ProfileKeeper(tmp_path / "anna.toml", pytest.fail).close()
    assert not list(tmp_path.iterdir())


def test_a_full_disk_is_told_once(tmp_path: Path, monkeypatch):
    def write(path: Path, given: Profile) -> None:
        raise OutputError(f"{path}: no space left")

    monkeypatch.setattr(keeper, "write_profile", write)
    told: list[str] = []
    kept = ProfileKeeper(tmp_path / "anna.toml", told.append, pause_s=0.01)
    for gain in (1.0, 2.0, 3.0):
        kept.keep(profile(gain))
        time.sleep(0.05)
    kept.close()
    assert told == [f"{tmp_path / 'anna.toml'}: no space left; what is changed now is forgotten at the end"]
