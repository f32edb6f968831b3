"""`track compare` holds the person's own left against the phone's, whatever the avatar shows."""

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from regress.runtime.sample import Sample
from track.cli import app, running
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
