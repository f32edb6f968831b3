"""A headset with a camera left out is calibrated by those that are there, and again once the other one is there too."""

import shutil
import sys

import pytest

from tests.track.session.faces import SAMPLES
from track.cli import main
from track.profile.profile import read_profile

EYES = ("left_eye", "right_eye")
ALL = (*EYES, "mouth")


@pytest.fixture
def rest(tmp_path, monkeypatch):
    """A folder to be in, with a third of a second at rest of each camera."""
    for name in ("XDG_CONFIG_HOME", "HOME", "APPDATA", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.chdir(tmp_path)
    for name in ALL:
        (tmp_path / name).mkdir()
        for file in sorted((SAMPLES / "headset" / name).iterdir())[:10]:
            shutil.copy(file, tmp_path / name)
    return tmp_path


def ended(monkeypatch, *words: str) -> int:
    monkeypatch.setattr(sys, "argv", ["track", *words])
    with pytest.raises(SystemExit) as end:
        main()
    return end.value.code


def test_the_others_are_calibrated_and_one_that_comes_later_wants_it_again(rest, monkeypatch, capsys):
    eyes, every = (
        [
            "--fast",
            "--profile",
            "me.toml",
            *(word for name in names for word in ("--camera", f"{name}={name}")),
        ]
        for names in (EYES, ALL)
    )
    assert ended(monkeypatch, "calibrate", "neutral", "--loop", *eyes) == 0, capsys.readouterr().err
    assert set(read_profile("me.toml").neutral.pictures) == set(EYES)
    assert ended(monkeypatch, "--no-page", *eyes) == 0, capsys.readouterr().err
    assert ended(monkeypatch, "--no-page", *every) == 0
    assert "mouth: it gave no picture when your neutral face was taken" in capsys.readouterr().err
    assert ended(monkeypatch, "calibrate", "neutral", "--loop", *every) == 0, capsys.readouterr().err
    assert set(read_profile("me.toml").neutral.pictures) == set(ALL)
    assert ended(monkeypatch, "--no-page", *eyes) == 0, capsys.readouterr().err
