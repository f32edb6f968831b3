"""`track compare` holds the person's own left against the phone's, whatever the avatar shows."""

import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from regress.runtime.sample import Sample
from track.cli import app, main, running
from track.cli.compare import delay_in_words, judging
from track.errors import InputError
from track.profile.profile import Profile, write_profile


@pytest.mark.parametrize(
    ("words", "mirrored"), [(("compare", "--truth", "livelink:0"), False), (("run", "--no-page"), True)]
)
def test_a_profile_mirrors_the_avatar_and_no_comparison(words, mirrored, tmp_path, monkeypatch):
    pictures = tmp_path / "pictures"
    pictures.mkdir()
    cv2.imwrite(str(pictures / "1.png"), np.full((48, 64), 99, dtype=np.uint8))
    profile = write_profile(tmp_path / "anna.toml", Profile(person="anna", camera="pictures", mirror=True))
    opened, shown = running.open_session, []

    def seen(*args, **kwargs):
        session, _ = opened(*args, **kwargs)
        shown.append(session.moment(Sample(time_s=0.0)).settings["mirror"])
        raise InputError("that is all")

    monkeypatch.setattr(running, "open_session", seen)
    words = (*words, "--camera", str(pictures), "--detector", "points", "--profile", str(profile))
    CliRunner().invoke(app, words)
    assert shown == [mirrored]


@pytest.mark.parametrize(
    ("keep", "missing", "words"),
    [("take", "pyarrow.parquet", "needs the learn extra"), ("none/take", None, "there is no folder")],
)
def test_a_take_that_cannot_be_kept_is_told_before_anybody_acts(
    keep, missing, words, tmp_path, monkeypatch, capsys
):
    if missing is not None:
        monkeypatch.setitem(sys.modules, missing, None)
    monkeypatch.setattr(running, "open_session", lambda *_, **__: pytest.fail("a person would have acted"))
    monkeypatch.setattr(
        sys, "argv", ["track", "compare", "--truth", "livelink:0", "--keep", str(tmp_path / keep)]
    )
    with pytest.raises(SystemExit):
        main()
    assert words in capsys.readouterr().err


@pytest.mark.parametrize(("delay_s", "words"), [(0.18, "180 ms later"), (-0.507, "507 ms earlier")])
def test_a_phone_that_is_earlier_is_not_later_by_less_than_nothing(delay_s, words):
    assert delay_in_words(delay_s) == words


def test_a_take_without_a_neutral_face_is_not_judged_against_one():
    """`regress evaluate --calibrated` would find nothing to score in it."""
    assert judging(Path("my take"), calibrated=True) == "regress evaluate MODEL 'my take' --calibrated"
    assert judging(Path("take"), calibrated=False) == "regress evaluate MODEL take"
