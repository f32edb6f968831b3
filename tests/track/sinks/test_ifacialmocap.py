"""iFacialMocap, read by the rules of VRCFaceTracking's module, with its greeting and what a lost face is."""

import math
import socket

import numpy as np
import psutil
import pytest
from hypothesis import given

from facegen.conventions import BLENDSHAPES, mirrored_name
from facegen.geometry import rotation_from_angles
from regress.runtime.sample import Sample
from tests.track.sinks.receivers import ANY_SAMPLE, acted, lost, received, receiver
from tests.track.sinks.test_axes import ANGLES, MIRROR_X, unity_euler_matrix
from track.sinks.ifacialmocap import GREETING, GreetedSink, IFacialMocap, app_name
from track.sinks.targets import Target, open_sink, parse_target


def parsed(datagram: bytes) -> tuple[dict[str, int], dict[str, list[float]]]:
    """Weights and bones, by the module's rules: parts between bars, exactly one sign of equality, whole numbers.

    The module skips what stands first, which is the status.
    """
    text = datagram.decode("ascii")
    assert text.endswith("|")
    halves = text.split("=")
    assert len(halves) == 2
    weights, bones = {}, {}
    for part in halves[0].split("|")[1:-1]:
        name, value = part.split("&" if "&" in part else "-")
        weights[name] = int(value)
    for part in halves[1].split("|")[:-1]:
        name, numbers = part.split("#")
        bones[name] = [float(number) for number in numbers.split(",")]
    return weights, bones


@pytest.mark.parametrize("version", [1, 2])
def test_a_receiver_reads_all_of_it(version):
    sample = acted()
    with receiver() as taken:
        address = f"ifacialmocap:127.0.0.1:{taken.getsockname()[1]},version={version}"
        sink = open_sink(parse_target(address), pytest.fail)
        sink.send(sample)
        (datagram,) = received(taken, 1)
        sink.close()
    assert (b"&" in datagram) == (version == 2)
    weights, bones = parsed(datagram)
    assert len(weights) == 52 + 2
    assert datagram.startswith(b"trackingStatus&1|" if version == 2 else b"trackingStatus-1|")
    for name, weight in zip(BLENDSHAPES, sample.weights, strict=True):
        assert weights[app_name(name)] == pytest.approx(100 * weight, abs=0.5001)
    assert weights["browInnerUp_L"] == weights["browInnerUp_R"] == weights["browInnerUp"]
    yaw, pitch, roll = np.degrees(sample.head[3:])
    np.testing.assert_allclose(bones["head"], [-pitch, yaw, -roll, 0.1, 0.05, -0.6], atol=1e-4)
    left_yaw, left_pitch, right_yaw, right_pitch = np.degrees(sample.gaze)
    np.testing.assert_allclose(bones["leftEye"], [-left_pitch, left_yaw, 0], atol=1e-4)
    np.testing.assert_allclose(bones["rightEye"], [-right_pitch, right_yaw, 0], atol=1e-4)


def test_names_are_the_app_s():
    assert [
        app_name(name) for name in ("jawLeft", "mouthRight", "mouthClose", "eyeBlinkLeft", "browDownRight")
    ] == [*("jawLeft", "mouthRight", "mouthClose", "eyeBlink_L", "browDown_R")]
    assert len({app_name(name) for name in BLENDSHAPES}) == 52


def test_mirrored_sides_are_what_vrcfacetracking_takes():
    sample = acted()
    own, mirrored = (parsed(IFacialMocap(sides=sides)(sample)[0]) for sides in ("own", "mirrored"))
    exchanged = {app_name(mirrored_name(name)): own[0][app_name(name)] for name in BLENDSHAPES}
    assert exchanged.items() <= mirrored[0].items()
    # the module's gaze of an eye, positive to the person's right, and upwards
    (pitch, yaw, _), (left_yaw, left_pitch) = mirrored[1]["leftEye"], sample.gaze[:2]
    assert math.tan(yaw / 90) * left_yaw < 0 < -math.tan(pitch / 90) * left_pitch
    # its head, by UpdateHeadData and UnifiedData.cs: down, to the right, tilted to the left
    down, to_the_right, tilted_left, *_ = mirrored[1]["head"]
    np.testing.assert_allclose([-to_the_right, -down, tilted_left], np.degrees(sample.head[3:]), atol=1e-4)


def test_eyes_turn_as_in_a_packet_of_the_app():
    """eyeLookIn_R-54, eyeLookOut_L-44, eyeLookDown-16 came with rightEye#5.36,19.07 and leftEye#5.56,15.62."""
    weights = np.zeros(52)
    for name, weight in {"eyeLookInRight": 0.54, "eyeLookOutLeft": 0.44, "eyeLookDownLeft": 0.16}.items():
        weights[BLENDSHAPES.index(name)] = weight
    left_and_down = np.radians([15.6168, -5.5606, 19.068, -5.3555])
    named, bones = parsed(IFacialMocap()(Sample(weights=weights, gaze=left_and_down))[0])
    assert (named["eyeLookIn_R"], named["eyeLookOut_L"], named["eyeLookDown_L"]) == (54, 44, 16)
    np.testing.assert_allclose(bones["rightEye"], [5.3555, 19.068, 0], atol=1e-4)
    np.testing.assert_allclose(bones["leftEye"], [5.5606, 15.6168, 0], atol=1e-4)


@given(angles=ANGLES)
def test_a_unity_program_turns_the_head_as_the_person_does(angles):
    """By UnityIFM's IFMPacket.cs, which changes the signs of y and z for ``Quaternion.Euler``."""
    head = np.array([0.1, -0.05, 0.6, *angles])
    _, bones = parsed(IFacialMocap()(Sample(weights=np.zeros(52), head=head))[0])
    turn = unity_euler_matrix(np.array(bones["head"][:3]) * [1, -1, -1])
    np.testing.assert_allclose(turn, MIRROR_X @ rotation_from_angles(*angles) @ MIRROR_X, atol=1e-5)


def test_a_lost_face_is_told_and_repeats_the_last_numbers():
    sending = IFacialMocap()
    assert sending(lost()) == []
    (shown,) = sending(acted())
    (gone,) = sending(lost())
    assert gone == shown.replace(b"trackingStatus-1", b"trackingStatus-0")
    assert sending(lost()) == [gone]  # by the last byte, which VMagicMirror takes for a lost face
    assert sending(acted(1))[0].startswith(b"trackingStatus-1|")


def _greeted(sink: GreetedSink, taken: socket.socket, listen: tuple[str, int]) -> bytes:
    sink.send(acted())
    before = taken.recv(65536)
    taken.sendto(GREETING + b"|sendDataVersion=v2", listen)
    sink.send(acted())
    after = taken.recv(65536)
    assert b"&" not in before
    return after


def test_a_greeting_is_answered_in_the_version_that_it_asks_for():
    with receiver() as taken, receiver() as free:
        listen = free.getsockname()
        free.close()
        target = Target(name="ifacialmocap", host="127.0.0.1", port=taken.getsockname()[1])
        sink = GreetedSink(target, pytest.fail, listen=listen)
        assert b"&" in _greeted(sink, taken, listen)
        taken.sendto(GREETING, listen)
        sink.send(acted())
        assert b"&" not in taken.recv(65536)
        sink.close()


def test_a_stranger_s_greeting_is_not_answered():
    with receiver() as taken, receiver("127.0.0.2") as stranger, receiver() as free:
        listen = free.getsockname()
        free.close()
        target = Target(name="ifacialmocap", host="127.0.0.1", port=taken.getsockname()[1])
        sink = GreetedSink(target, pytest.fail, listen=listen)
        stranger.sendto(GREETING + b"|sendDataVersion=v2", listen)
        stranger.sendto(b"x" * 4000, listen)
        sink.send(acted())
        assert b"&" not in taken.recv(65536)
        stranger.settimeout(0.05)
        with pytest.raises(TimeoutError):
            stranger.recv(65536)
        sink.close()


def test_a_port_that_is_taken_is_told_once_and_sending_goes_on():
    told = []
    with receiver() as taken, receiver() as busy:
        target = Target(name="ifacialmocap", host="127.0.0.1", port=taken.getsockname()[1])
        sink = GreetedSink(target, told.append, listen=busy.getsockname())
        sink.send(acted())
        sink.send(acted(1))
        assert len(received(taken, 2)) == 2
        sink.close()
    assert len(told) == 1
    assert "is taken" in told[0]


def test_a_receiver_on_this_machine_has_the_port_of_greetings(monkeypatch):
    """By any address of the machine: that of its network was taken for another machine's."""
    own = [
        each.address
        for all_ in psutil.net_if_addrs().values()
        for each in all_
        if each.family == socket.AF_INET
    ]
    asked = []
    monkeypatch.setattr("track.sinks.ifacialmocap.GreetedSink", lambda *_, **options: asked.append(options))
    for host in (*own, "203.0.113.77"):
        open_sink(parse_target(f"ifacialmocap:{host}"), pytest.fail)
    assert asked == [{}] * len(own) + [{"listen": ("0.0.0.0", 49983)}]


@given(sample=ANY_SAMPLE)
def test_whatever_stages_leave_is_read_by_the_rules(sample):
    for datagram in IFacialMocap()(sample):
        weights, bones = parsed(datagram)
        assert all(0 <= weight <= 100 for weight in weights.values())
        assert {name: len(numbers) for name, numbers in bones.items()} == {
            "head": 6,
            "rightEye": 3,
            "leftEye": 3,
        }
