"""Live Link Face, read by its published layout, and by PyLiveLinkFace where that is installed."""

import struct

import numpy as np
import pytest
from hypothesis import given

from facegen.conventions import BLENDSHAPES
from regress.runtime.sample import Sample
from tests.track.sinks.receivers import ANY_SAMPLE, acted, lost, received, receiver
from track.sinks.live_link import LiveLink
from track.sinks.targets import open_sink, parse_target

HEADER = "!BI36sI6sifii"


def floats(datagram: bytes) -> np.ndarray:
    """What receivers read that look at the end alone: 61 floats."""
    return np.frombuffer(datagram[-244:], ">f4")


def test_a_datagram_has_the_layout_of_live_link_face():
    sample = acted(time_s=10.26)
    with receiver() as taken:
        sink = open_sink(parse_target(f"livelink:127.0.0.1:{taken.getsockname()[1]}"), pytest.fail)
        sink.send(sample)
        (datagram,) = received(taken, 1)
        sink.close()
    version, length, device, subject_length, subject, frame, part, rate, one = struct.unpack_from(
        HEADER, datagram
    )
    assert (version, length, subject_length, subject, frame, rate, one) == (6, 36, 6, b"Webcam", 615, 60, 1)
    assert [len(group) for group in device.split(b"-")] == [8, 4, 4, 4, 12]
    assert part == pytest.approx(0.6, abs=1e-6)
    assert len(datagram) == struct.calcsize(HEADER) + 1 + 244
    assert datagram[-245] == 61
    assert len(datagram) == 312  # VRCFaceTracking's module looks at no other


def test_floats_are_in_the_order_of_unreal_s_enumeration():
    sample = acted()
    values = floats(LiveLink()(sample)[0])
    np.testing.assert_allclose(values[:52], sample.weights, atol=1e-7)
    # EARFaceBlendShape: 15 JawLeft, 16 JawRight, 21 MouthLeft, 22 MouthRight, which the app's recordings have reversed
    places = {
        "jawForward": 14,
        "jawLeft": 15,
        "jawRight": 16,
        "jawOpen": 17,
        "mouthLeft": 21,
        "mouthRight": 22,
    }
    assert {name: BLENDSHAPES.index(name) for name in places} == places


def test_angles_by_their_unit_and_sign():
    sample = acted()
    radians, turns = (floats(LiveLink(angles=unit)(sample)[0])[52:] for unit in ("radians", "half-turns"))
    np.testing.assert_allclose(turns * 180, np.degrees(radians), atol=1e-4)
    yaw, pitch, roll = sample.head[3:]
    left_yaw, left_pitch, right_yaw, right_pitch = sample.gaze
    expected = [yaw, pitch, -roll, -left_yaw, -left_pitch, 0, -right_yaw, -right_pitch, 0]
    np.testing.assert_allclose(radians, expected, atol=1e-7)


def test_vrcfacetracking_turns_head_and_eyes_as_the_person_does():
    """By ArKitPacketReader.cs, and the senses of UnifiedData.cs: yaw to the right, pitch down, roll to the left."""
    head, gaze = np.array([0, 0, 0.6, 0.3, 0.2, 0.1]), np.array([0.3, 0.2, 0.3, 0.2])
    angles = floats(LiveLink()(Sample(weights=np.zeros(52), head=head, gaze=gaze))[0])[52:]
    to_the_right, down, tilted_left = -angles[:3]
    np.testing.assert_allclose([to_the_right, down, tilted_left], [-0.3, -0.2, 0.1], atol=1e-7)
    gaze_x, gaze_y = angles[3], -angles[4]  # to the right and upwards are positive
    np.testing.assert_allclose([gaze_x, gaze_y], [-0.3, 0.2], atol=1e-7)


def test_pylivelinkface_reads_it():
    pylivelinkface = pytest.importorskip(
        "pylivelinkface", reason="PyLiveLinkFace is not installed: no licence is named"
    )
    sample = acted()
    good, face = pylivelinkface.PyLiveLinkFace.decode(LiveLink(subject="Somebody")(sample)[0])
    assert good
    assert face.name == "Somebody"
    shapes = pylivelinkface.FaceBlendShape
    for name, weight in zip(BLENDSHAPES, sample.weights, strict=True):
        assert face.get_blendshape(shapes[name[0].upper() + name[1:]]) == pytest.approx(weight, abs=1e-6)
    assert face.get_blendshape(shapes["HeadYaw"]) == pytest.approx(sample.head[3], abs=1e-6)
    assert face.get_blendshape(shapes["RightEyePitch"]) == pytest.approx(-sample.gaze[3], abs=1e-6)
    good, _ = pylivelinkface.PyLiveLinkFace.decode(LiveLink()(lost())[0])
    assert not good


@pytest.mark.parametrize(
    ("subject", "said"), [("", 0), (",subject=Anna B", 0), (",subject=Jörgen", 1), (",subject=Me", 1)]
)
def test_a_subject_that_vrcfacetracking_does_not_take_is_told(subject, said):
    """Of a length of 312 bytes it takes all, and no other: six bytes of UTF-8, not letters."""
    told = []
    open_sink(parse_target(f"livelink{subject}"), told.append).close()
    assert len(told) == said


def test_a_lost_face_is_a_header_alone():
    assert len(LiveLink()(lost())[0]) == struct.calcsize(HEADER)


@given(sample=ANY_SAMPLE)
def test_whatever_stages_leave_is_one_datagram(sample):
    (datagram,) = LiveLink()(sample)
    size = struct.calcsize(HEADER)
    assert len(datagram) in (size, size + 245)
    if len(datagram) > size:
        assert np.isfinite(floats(datagram)).all()
