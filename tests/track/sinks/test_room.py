"""A face in a room: the same bytes as the room's own vectors, and a real room that shows it to the others."""

import asyncio
import json
import re
import shutil
import ssl
import subprocess
import threading
from pathlib import Path

import numpy as np
import pytest
from aiohttp import web

from room.protocol import Flag, Message, decode
from room.protocol.answers import Changed
from tests.room.guests import open_room
from tests.serving import serving
from tests.track.sinks.receivers import acted, lost
from track.errors import InputError
from track.sinks.axes import head_pose
from track.sinks.room_state import TRACKED, face_state
from track.sinks.targets import open_sink, parse_target

VECTORS = json.loads(Path("room/protocol/vectors.json").read_text())["states"]
FACE = ("flags", "sequence", "time_ms", "weights", "head_m", "rotation", "gaze")
BODY = 78
"""From here on are body, heading and animation, which a face leaves alone."""


@pytest.mark.parametrize("vector", VECTORS, ids=[vector["name"] for vector in VECTORS])
def test_bytes_are_those_of_the_room_s_vectors(vector):
    face = {name: vector["state"][name] for name in FACE}
    face["flags"] &= ~Flag.HANDS  # a face knows of no hands, whose flag makes a state longer
    expected = bytearray.fromhex(vector["hex"])[:BODY]
    expected[1] = face["flags"]
    assert face_state(**face) == bytes(expected) + bytes(7)


def test_what_is_not_known_rests():
    assert decode(face_state(flags=0, sequence=65537, time_ms=2**32 + 5, weights=np.zeros(52))) == Message(
        sequence=1, time_ms=5
    )


def test_others_in_a_room_see_the_face_move():
    told, sample = [], acted(time_s=2.0)

    async def meet() -> Message:
        async with open_room() as place:
            ada, bob = await place.guest(), await place.guest(name="Bob")
            link = f"{place.address}/room/{place.name}#{place.join().key}.{ada.secret}"
            sink = await asyncio.to_thread(open_sink, parse_target(f"room:{link}"), told.append)
            assert ada.secret not in sink.title
            while ada.number not in bob.states:  # the newest alone is kept until the room has let the face in
                sink.send(sample)
                await asyncio.sleep(0.02)
            await bob.told(Changed, lambda answer: answer.person.face == "program")
            seen = bob.states[ada.number]
            await asyncio.to_thread(sink.close)
            await bob.told(Changed, lambda answer: answer.person.face == "page")
            await ada.go()
            await bob.go()
            return seen

    seen = asyncio.run(asyncio.wait_for(meet(), 120))
    assert seen.flags == TRACKED
    np.testing.assert_allclose(seen.weights, sample.weights, atol=0.5001 / 255)
    np.testing.assert_allclose(seen.rotation, head_pose(sample.head).rotation, atol=1e-4)
    np.testing.assert_allclose(seen.gaze, sample.gaze, atol=np.radians(0.25001))
    assert seen.head_m == (0, 0, 0)  # it rests where it was seen first
    assert told == []
    assert "room" not in {thread.name for thread in threading.enumerate()}


def test_a_face_of_nobody_is_told_once_and_tried_again():
    told = []

    async def meet() -> None:
        async with open_room() as place:
            link = f"{place.address}/room/{place.name}#{place.join().key}.{'x' * 22}"
            sink = await asyncio.to_thread(open_sink, parse_target(f"room:{link}"), told.append)
            sink.send(lost())
            while not told:
                await asyncio.sleep(0.02)
            ada = await place.guest(secret="x" * 22)
            bob = await place.guest(name="Bob")
            while ada.number not in bob.states:
                sink.send(acted())
                await asyncio.sleep(0.02)
            await asyncio.to_thread(sink.close)
            await ada.go()
            await bob.go()

    asyncio.run(asyncio.wait_for(meet(), 120))
    assert len(told) == 1
    assert "open the page first" in told[0]


def test_a_wrong_key_ends_it():
    told = []

    async def meet() -> None:
        async with open_room() as place:
            link = f"{place.address}/room/{place.name}#{'k' * 22}.{'x' * 22}"
            sink = await asyncio.to_thread(open_sink, parse_target(f"room:{link}"), told.append)
            while not told:
                await asyncio.sleep(0.02)
            sink.send(acted())
            await asyncio.to_thread(sink.close)
            sink.send(acted())

    asyncio.run(asyncio.wait_for(meet(), 120))
    assert "is not, or no longer, one of this room" in told[0]


def test_a_room_that_is_away_is_told_once_and_costs_nothing():
    told = []
    sink = open_sink(parse_target(f"room:http://127.0.0.1:9/room/a#{'k' * 22}.{'x' * 22}"), told.append)
    for _ in range(20):
        sink.send(acted())
    while not told:
        threading.Event().wait(0.02)
    sink.close()
    assert len(told) == 1
    assert "nobody answers" in told[0]


@pytest.mark.parametrize(
    "word",
    ["[1]", '"no"', "null", "[" * 100_000, "1" * 5000, '{"kind": "refused", "text": ["a"], "again": true}'],
    ids=lambda word: word[:12],
)
def test_what_is_no_word_of_a_room_ends_no_thread(word, monkeypatch):
    """pytest makes an error of an exception that nobody takes in a thread."""
    monkeypatch.setattr("track.sinks.room.PAUSES_S", (0.02,))
    told, calls = [], []

    async def strange(request: web.Request) -> web.WebSocketResponse:
        calls.append(1)
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.send_str(word)
        await socket.close()
        return socket

    async def meet() -> None:
        app = web.Application()
        app.router.add_get("/room/a/socket", strange)
        async with serving(app) as port:
            link = f"http://127.0.0.1:{port}/room/a#{'k' * 22}.{'x' * 22}"
            sink = await asyncio.to_thread(open_sink, parse_target(f"room:{link}"), told.append)
            while len(calls) < 3:
                sink.send(acted())
                await asyncio.sleep(0.02)
            await asyncio.to_thread(sink.close)

    asyncio.run(asyncio.wait_for(meet(), 120))
    assert len(told) <= 1


@pytest.fixture(scope="module")
def certificates(tmp_path_factory) -> Path:
    """A folder with two certificates as docs/room.md makes them, and their keys."""
    if shutil.which("openssl") is None:
        pytest.skip("openssl makes the certificates")
    folder = tmp_path_factory.mktemp("certificates")
    for name in ("room", "other"):
        words = [
            "openssl",
            "req",
            "-x509",
            "-newkey",
            "rsa:2048",
            "-nodes",
            "-days",
            "2",
            "-subj",
            "/CN=room",
        ]
        words += ["-addext", "subjectAltName=DNS:room", "-out", f"{name}.pem", "-keyout", f"{name}.key"]
        subprocess.run(words, check=True, capture_output=True, cwd=folder)
    return folder


def by_https(certificates: Path, options: str) -> tuple[list[bytes], list[str]]:
    """States that came to a room by https until the sink said something or five were there, and what it said."""
    came, told = [], []

    async def welcome(request: web.Request) -> web.WebSocketResponse:
        socket = web.WebSocketResponse()
        await socket.prepare(request)
        await socket.receive_json()
        await socket.send_json({"kind": "welcome"})
        async for message in socket:
            came.append(message.data)
        return socket

    async def meet() -> None:
        app = web.Application()
        app.router.add_get("/room/a/socket", welcome)
        served = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
        served.load_cert_chain(certificates / "room.pem", certificates / "room.key")
        async with serving(app, certified=served) as port:
            link = f"https://127.0.0.1:{port}/room/a#{'k' * 22}.{'x' * 22}{options}"
            sink = await asyncio.to_thread(open_sink, parse_target(f"room:{link}"), told.append)
            while len(came) < 5 and not told:
                sink.send(acted())
                await asyncio.sleep(0.02)
            if told:  # and never tries again
                await asyncio.to_thread(sink._thread.join, 60)
                assert not sink._thread.is_alive()
            await asyncio.to_thread(sink.close)

    asyncio.run(asyncio.wait_for(meet(), 120))
    return came, told


def test_a_room_s_own_certificate_is_known_by_its_file(certificates):
    """By any address: who comes by a number has the same room as who comes by its name."""
    came, told = by_https(certificates, f",cert={certificates / 'room.pem'}")
    assert len(came) >= 5
    assert told == []


def test_a_certificate_that_nobody_knows_is_told_with_what_helps(certificates):
    came, told = by_https(certificates, "")
    assert came == []
    assert len(told) == 1
    assert re.search(r"does not trust the room's certificate \(self.signed certificate\)", told[0])
    assert "'room:LINK,cert=FILE'" in told[0]


def test_another_room_than_that_of_the_file_gets_no_secret(certificates):
    came, told = by_https(certificates, f",cert={certificates / 'other.pem'}")
    assert came == []
    assert len(told) == 1
    assert f"another certificate than {certificates / 'other.pem'}" in told[0]


@pytest.mark.parametrize(
    ("scheme", "content", "said"),
    [
        ("https", None, "cannot be read (No such file or directory)"),
        ("https", "hello", "holds no certificate"),
        ("https", "-----BEGIN CERTIFICATE-----\nAAAAA\n-----END CERTIFICATE-----\n", "holds no certificate"),
        ("http", "hello", "begins with https://"),
    ],
)
def test_a_file_that_holds_no_certificate_is_refused(scheme, content, said, tmp_path):
    if content is not None:
        (tmp_path / "cert.pem").write_text(content)
    link = f"{scheme}://127.0.0.1:9/room/a#{'k' * 22}.{'x' * 22},cert={tmp_path / 'cert.pem'}"
    with pytest.raises(InputError) as refused:
        open_sink(parse_target(f"room:{link}"), pytest.fail)
    assert said in str(refused.value)
    assert "xxx" not in str(refused.value)


@pytest.mark.parametrize(
    "link",
    [
        "http://127.0.0.1:8443/room/a",
        "http://127.0.0.1:8443/room/a#key",
        "http://127.0.0.1:8443/room/A#" + "k" * 22 + "." + "x" * 22,
        "ws://127.0.0.1:8443/room/a#" + "k" * 22 + "." + "x" * 22,
        "127.0.0.1:8443",
        "http:///room/a#" + "k" * 22 + "." + "x" * 22,
        "http://[::1/room/a#" + "k" * 22 + "." + "x" * 22,
        "http://127.0.0.1:99999/room/a#" + "k" * 22 + "." + "x" * 22,
    ],
)
def test_a_link_that_is_none_of_a_face_is_refused_without_its_secret(link):
    with pytest.raises(InputError, match="shows it as") as refused:
        open_sink(parse_target(f"room:{link}"), pytest.fail)
    assert "xxx" not in str(refused.value)
