"""`track compare` holds the person's own left against the phone's, whatever the avatar shows."""

import contextlib

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from regress.runtime.sample import Sample
from track.cli import app, running
from track.errors import InputError
from track.profile.profile import Profile, write_profile


def test_a_profile_that_mirrors_the_avatar_mirrors_no_comparison(tmp_path, monkeypatch):
    (tmp_path / "pictures").mkdir()
    cv2.imwrite(str(tmp_path / "pictures" / "1.png"), np.full((48, 64), 99, dtype=np.uint8))
    profile = write_profile(tmp_path / "anna.toml", Profile(person="anna", camera="pictures", mirror=True))
    opened, shown = running.open_session, []

    def seen(*args, **kwargs):
        session, capture = opened(*args, **kwargs)
        shown.append(session.moment(Sample(time_s=0.0)).settings["mirror"])
        raise InputError("that is all")

    monkeypatch.setattr(running, "open_session", seen)
    words = ["--truth", "livelink:0", "--camera", tmp_path / "pictures", "--detector", "points"]
    with contextlib.suppress(InputError):
        CliRunner().invoke(
            app, ["compare", *map(str, words), "--profile", str(profile)], catch_exceptions=False
        )
    assert shown == [False]
    with pytest.raises(InputError, match="that is all"), contextlib.ExitStack() as closing:
        wishes = running.Wishes(
            cameras=[str(tmp_path / "pictures")], detector="points", profile=str(profile)
        )
        texts = {"camera": str(tmp_path / "pictures")}
        running.open_session(wishes, texts, [], print, closing, options=running.RunOptions())
    assert shown == [False, True]
