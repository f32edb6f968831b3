"""`track` tells a network of drawn headsets where the cameras are, as `regress headset predict` does, and keeps it."""

import csv
import sys
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES, CAMERA_TERMS
from regress.cli import main as regress
from track.cli import main as track
from track.profile.profile import Profile, read_profile, write_profile

DRAWN = Path(__file__).parents[1] / "drawn_layout"
CAMERAS = ("left_eye", "right_eye", "mouth")
LIVE = [
    *("--model", "headset-any", "--fast", "--no-page", "--filter", "none", "--neutral", "none"),
    *(word for name in CAMERAS for word in ("--camera", f"{name}={DRAWN / name}")),
]
TOLD = ("--headset", str(DRAWN / "headset.toml"))


@pytest.fixture
def home(tmp_path, monkeypatch):
    for name in ("XDG_CONFIG_HOME", "HOME", "APPDATA", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def ended(monkeypatch, main, *words) -> int:
    monkeypatch.setattr(sys, "argv", ["program", *map(str, words)])
    with pytest.raises(SystemExit) as end:
        main()
    return end.value.code


def weights(path: Path) -> np.ndarray:
    """(n, 52); of shapes that do not come from the gaze, which `track` reads from both eyes together."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = [name for name in BLENDSHAPES if not name.startswith("eyeLook")]
    return np.array([[float(row[name]) for name in names] for row in rows])


def test_frames_of_a_drawn_layout_are_answered_as_predict_answers_them(home, monkeypatch, capsys):
    """Levels are given, as a take is levelled as a whole, and two frames a second leave time to fade in."""
    paths = [word for name in CAMERAS for word in (f"--{name.replace('_', '-')}", DRAWN / name)]
    levels = "".join(f"[cameras.{name}]\nsize = 0.9\nlow = 25.0\nhigh = 180.0\n" for name in CAMERAS)
    (home / "placement.toml").write_text(f"version = 1\n{levels}")
    placed = ("--placement", "placement.toml")
    for name, told in (("told", TOLD), ("untold", ())):
        table = f"{name}-live.csv"
        assert ended(monkeypatch, track, *LIVE, *told, *placed, "--fps", 2, "--record", table) == 0, (
            capsys.readouterr().err
        )
        words = ("headset", "predict", "headset-any", *paths, *told, *placed, "--out", f"{name}.csv")
        assert ended(monkeypatch, regress, *words) == 0, capsys.readouterr().err
    live, plain = weights(Path("told-live.csv")), weights(Path("untold-live.csv"))
    assert live.shape == (5, len(BLENDSHAPES) - 8)
    for found, name in ((live, "told"), (plain, "untold")):
        np.testing.assert_allclose(found[1:], weights(Path(f"{name}.csv"))[1:], atol=1e-5)
    # a thousand times as far as two programs may be apart
    assert np.abs(live - plain).max() > 0.01


def kept(monkeypatch, profile: Path, *words) -> dict[str, tuple[float, ...]]:
    """Cameras in a profile behind a session that changes it."""
    from track.session.session import Session

    def change(self, *arguments, **options):
        self.adjusting._keep(self.profile)
        return self.summary()

    with monkeypatch.context() as patch:
        patch.setattr(Session, "run", change)
        assert ended(monkeypatch, track, *LIVE, "--profile", profile, *words) == 0
    return read_profile(profile).told_cameras


def test_the_profile_keeps_it_and_none_forgets_it(home, monkeypatch, capsys):
    profile = home / "me.toml"
    first = kept(monkeypatch, profile, *TOLD)
    assert set(first) == set(CAMERAS)
    assert all(len(terms) == len(CAMERA_TERMS) for terms in first.values())
    assert ended(monkeypatch, track, *LIVE, "--profile", profile, "--record", "kept.csv") == 0
    assert ended(monkeypatch, track, *LIVE, *TOLD, "--record", "told.csv") == 0
    np.testing.assert_array_equal(weights(Path("kept.csv")), weights(Path("told.csv")))
    assert kept(monkeypatch, profile) == first
    assert ended(monkeypatch, track, "profiles", "show", profile) == 0
    assert "places known of: left_eye, right_eye, mouth" in capsys.readouterr().out
    assert kept(monkeypatch, profile, "--headset", "none") == {}


def test_a_model_of_one_headset_says_that_it_is_not_told(home, monkeypatch, capsys):
    write_profile(
        home / "me.toml",
        Profile(person="me", camera="three", told_cameras={"mouth": (0.0,) * len(CAMERA_TERMS)}),
    )
    words = [word if word != "headset-any" else "headset-tracking3" for word in LIVE]
    assert ended(monkeypatch, track, *words, "--profile", "me.toml") == 0
    assert "this model is not told" in capsys.readouterr().err


def test_a_file_without_one_of_the_cameras_leaves_it_unknown_and_says_so(home, monkeypatch, capsys):
    text = (DRAWN / "headset.toml").read_text().replace('"mouth"', '"chin"')
    (home / "two.toml").write_text(text)
    assert ended(monkeypatch, track, *LIVE, "--headset", "two.toml") == 0
    assert "two.toml does not have mouth" in capsys.readouterr().err
