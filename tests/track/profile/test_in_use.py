"""A profile in use: options and another model go before what its file holds, and take nothing out of the file."""

from dataclasses import replace

import numpy as np
import pytest

from regress.runtime.stages.own_blinks import Ends
from tests.track.session.faces import Given, calibrated_profile, frames, new_session
from track.cli.opening import Wishes
from track.cli.opening_profile import open_profile
from track.messages import Command
from track.profile.profile import ModelMark, Profile, read_profile, write_profile

ANOTHER = ModelMark(kind="landmarks", sha256="0" * 64)


@pytest.fixture
def file(tmp_path):
    mark = new_session().pipeline.mark
    blinks = {"eyeBlinkLeft": Ends(open=0.1, full=0.5)}
    known = {"ranges": {"jawOpen": 0.6}, "rests": {"jawOpen": 0.1}, "blinks": blinks, "model": mark}
    return write_profile(tmp_path / "anna.toml", calibrated_profile().model_copy(update=known))


def opened(path, neutral: str | None = None):
    """A session by the profile, and what it says."""
    said: list[str] = []
    wishes = Wishes(profile=str(path), neutral=neutral)
    used, kept, path = open_profile(wishes, new_session().pipeline, {"camera": "camera 0"}, said.append)
    session = new_session(
        profile=used, kept=kept, keep=lambda profile: write_profile(path, profile), said=said
    )
    return session, said


def of_another_model(path) -> Profile:
    changed = read_profile(path).model_copy(update={"model": ANOTHER})
    write_profile(path, changed)
    return changed


@pytest.mark.parametrize("neutral", ["none", "auto", "docs/samples/talking-face.csv", None])
def test_a_mirror_and_a_gain_change_nothing_else_of_the_file(file, neutral):
    before = read_profile(file) if neutral else of_another_model(file)
    session, _ = opened(file, neutral)
    session.ask(Command(verb="mirror", value=True))
    session.ask(Command(verb="gain", shape="jawOpen", value=1.5))
    session.answer(frames(0, 1)[0])
    assert session.profile.mirror
    assert session.profile.ranges == {}
    assert read_profile(file) == before.model_copy(update={"mirror": True, "gains": {"jawOpen": 1.5}})


@pytest.mark.parametrize("neutral", ["none", "auto", None])
def test_what_was_read_with_another_neutral_face_or_model_is_left_out(file, neutral):
    """Rests are taken off each weight: those of another model's answers say nothing of this one's."""
    if neutral is None:
        of_another_model(file)
    session, _ = opened(file, neutral)
    assert session.profile.ranges == session.profile.rests == session.profile.blinks == {}
    assert not session.profile.at_rest().any()


def calibrate(session, face: str) -> None:
    """With a face that does not move, and reads all that any face is asked for."""
    still = replace(frames(0, 1)[0], weights=np.full(52, 0.7))
    session.pipeline.stages = {"given": Given()}
    session.ask(Command(verb="calibrate", value=face))
    count = 0
    while count == 0 or session.adjusting.calibrating:
        session.answer(replace(still, time_s=count / 30))
        count += 1


def test_another_neutral_face_leaves_ranges_as_they_were(file):
    """As the sentences of a calibration say, in which a later face fails or that is cancelled."""
    session, _ = opened(file)
    calibrate(session, "neutral")
    after = read_profile(file)
    assert (after.ranges, after.rests, after.blinks) == ({"jawOpen": 0.6}, {}, {})


def test_a_new_neutral_face_is_kept_and_what_is_read_without_the_profile_s_is_not(file):
    before = read_profile(file)
    session, said = opened(file, "none")
    calibrate(session, "jaw_open")
    assert session.profile.ranges == {"jawOpen": pytest.approx(0.7)}
    assert read_profile(file) == before
    assert "jaw_open is not kept: it was read without the neutral face of the profile" in said
    calibrate(session, "neutral")
    calibrate(session, "smile")
    after = read_profile(file)
    assert after.neutral == session.profile.neutral != before.neutral
    assert set(after.ranges) == {"mouthSmileLeft", "mouthSmileRight"}
