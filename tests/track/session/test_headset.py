"""A headset's session: neutral pictures through the profile, and what the network traces, for the page."""

import base64
import struct
import zlib

import numpy as np
import pytest

from tests.track.session.test_chaos import HEADSET, headset_frames, headset_session
from track.errors import InputError
from track.messages import Command
from track.profile.profile import NeutralFace, read_profile, write_profile


def _chunk(name: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


HUGE = base64.b64encode(
    b"\x89PNG\r\n\x1a\n"
    + _chunk(b"IHDR", struct.pack(">IIBBBBB", 20_000, 20_000, 8, 0, 0, 0, 0))
    + _chunk(b"IDAT", zlib.compress(bytes(20_001 * 100)))
    + _chunk(b"IEND", b"")
).decode()
"""A picture of some kB that wants 0.4 GB."""


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
        (NeutralFace(pictures=dict.fromkeys(HEADSET, "AAAAA")), "left_eye is none, and the model"),
        (NeutralFace(pictures=dict.fromkeys(HEADSET, "é")), "left_eye is none, and the model"),
        (NeutralFace(pictures=dict.fromkeys(HEADSET, HUGE)), "left_eye is 20000 x 20000, and the model"),
        (
            NeutralFace(pictures=dict.fromkeys(HEADSET, "AAAA")),
            "left_eye is none, and the model takes 96 x 96",
        ),
    ],
)
def test_a_neutral_face_of_something_else_is_refused(neutral, words):
    with pytest.raises(InputError, match=words):
        headset_session().pipeline.use_neutral(neutral)
