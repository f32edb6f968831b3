"""A headset's session: neutral pictures through the profile, and what the network traces, for the page."""

import numpy as np
import pytest

from tests.track.session.test_chaos import HEADSET, headset_frames, headset_session
from track.errors import InputError
from track.messages import Command
from track.profile.profile import NeutralFace, read_profile, write_profile


def test_a_neutral_face_is_the_same_after_a_profile_s_file(tmp_path):
    """PNG loses nothing, so answers are equal to the last digit."""
    plain = headset_session()
    stored = read_profile(write_profile(tmp_path / "p.toml", plain.profile))
    assert stored == plain.profile
    other = headset_session()
    other.pipeline.use_neutral(stored.neutral)
    for sample in headset_frames()[:20]:
        plain.answer(sample)
        other.answer(sample)
    np.testing.assert_array_equal(plain.sinks[0].weights, other.sinks[0].weights)


def test_points_are_traced_where_somebody_looks():
    session = headset_session()
    first = session.answer(headset_frames()[0])[0]
    assert session.moment(first).points == {}
    session.ask(Command(verb="picture", value=True))
    second = session.answer(headset_frames()[1])[0]
    moment = session.moment(second)
    assert set(moment.points) == set(moment.pictures) == set(HEADSET)
    for name, points in moment.points.items():
        height, width = moment.pictures[name].shape
        inside = ((points > -5) & (points < [width + 5, height + 5])).all(axis=1)
        assert inside.mean() > 0.9


@pytest.mark.parametrize(
    ("neutral", "words"),
    [
        (NeutralFace(detector="mediapipe"), "takes a headset's pictures"),
        (NeutralFace(pictures={"mouth": "AAAA"}), "no neutral picture of left_eye"),
        (
            NeutralFace(pictures=dict.fromkeys(HEADSET, "AAAA")),
            "left_eye is none, and the model takes 96 x 96",
        ),
    ],
)
def test_a_neutral_face_of_something_else_is_refused(neutral, words):
    with pytest.raises(InputError, match=words):
        headset_session().pipeline.use_neutral(neutral)
