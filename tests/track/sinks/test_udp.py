"""What a receiver is left with when `track` ends: a face at rest that nobody tracks, said twice."""

import socket
from collections import Counter

import pytest

from tests.track.sinks.receivers import acted, lost, receiver
from tests.track.sinks.test_ifacialmocap import parsed
from tests.track.sinks.test_vmc import messages
from track.sinks.targets import SINKS, open_sink, parse_target

UDP = [name for name, kind in SINKS.items() if kind.port is not None]


def waiting(taken: socket.socket) -> list[bytes]:
    """What has come; on one machine a datagram is there as soon as it is sent."""
    taken.setblocking(False)
    came = []
    while True:
        try:
            came.append(taken.recv(65536))
        except BlockingIOError:
            return came


def left(name: str, *samples) -> list[bytes]:
    """What closing the sink of that name sends, after some samples."""
    with receiver() as taken:
        sink = open_sink(parse_target(f"{name}:127.0.0.1:{taken.getsockname()[1]}"), pytest.fail)
        for sample in samples:
            sink.send(sample)
        waiting(taken)
        sink.close()
        return waiting(taken)


@pytest.mark.parametrize("name", UDP)
def test_the_last_words_are_said_twice(name):
    counts = Counter(left(name, acted()))
    assert len(counts) > 1
    assert set(counts.values()) == {2}


@pytest.mark.parametrize("name", UDP)
def test_who_showed_no_face_says_nothing(name):
    assert left(name) == left(name, lost()) == []


def test_vmc_leaves_a_face_at_rest_and_says_that_nobody_is_tracked():
    got = messages(left("vmc", acted()))
    assert {each.params[1] for each in got if each.address.endswith("Val")} == {0}
    turns = [each.params[4:] for each in got if each.address.endswith("Bone/Pos")]
    assert len(turns) == 2 * 4
    assert all(turn == [0, 0, 0, 1] for turn in turns)
    states = [each.params[3] for each in got if each.address.endswith("OK")]
    assert states == [1, 1, 0, 0]


def test_vrchat_gets_its_face_back():
    got = {each.address: each.params for each in messages(left("vrchat", acted()))}  # the last of each
    assert got["/avatar/parameters/EyeTrackingActive"] == [False]
    assert got["/avatar/parameters/v2/JawOpen"] == [0]
    assert got["/avatar/parameters/v2/EyeLidLeft"] == [0.75]
    assert got["/tracking/eye/LeftRightPitchYaw"] == [0] * 4


def test_ifacialmocap_leaves_a_face_at_rest():
    *_, last = left("ifacialmocap", acted())
    weights, bones = parsed(last)
    assert last.startswith(b"trackingStatus-0|")
    assert set(weights.values()) == {0}
    assert bones["head"] == [0, 0, 0, 0.1, 0.05, -0.6]
