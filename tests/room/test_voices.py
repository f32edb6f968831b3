"""Voices through a real Janus: whose voice a page is offered, who gets in, and Janus killed and started again."""

import asyncio
import secrets
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager

import aiohttp
import pytest

from room.avatars import AvatarStore
from room.protocol.answers import Engine, Signal
from room.server import Keys, Limits, Relays
from room.server.janus import Janus
from room.server.live_rooms import LiveRooms
from room.server.voice_room import instance_of, voice_room
from room.state.meeting import MOST_BEYOND
from tests.room.engines import API_SECRET, free_port, janus, needs_janus
from tests.room.guests import SOON_S, Guest, Place, open_room

pytestmark = needs_janus

OFFER = "\r\n".join(
    (
        "v=0",
        "o=- 1 2 IN IP4 127.0.0.1",
        "s=-",
        "t=0 0",
        "a=group:BUNDLE 0",
        "m=audio 9 UDP/TLS/RTP/SAVPF 111",
        "c=IN IP4 0.0.0.0",
        "a=rtcp:9 IN IP4 0.0.0.0",
        "a=ice-ufrag:abcd",
        "a=ice-pwd:abcdefghijklmnopqrstuvwx",
        "a=fingerprint:sha-256 " + ":".join(["AB"] * 32),
        "a=setup:actpass",
        "a=mid:0",
        "a=sendonly",
        "a=rtcp-mux",
        "a=rtpmap:111 opus/48000/2",
        "a=fmtp:111 minptime=10;useinbandfec=1",
        "a=ssrc:1 cname:a",
        "",
    )
)
"""What a browser offers, as short as may be: Janus answers it, though nothing is ever sent."""


@asynccontextmanager
async def voiced(port: int, keys: Keys | None = None) -> AsyncIterator[Place]:
    """A server whose voices go by a Janus."""
    engine = Janus(f"ws://127.0.0.1:{port}", secret=API_SECRET)
    async with open_room(keys=keys, engines=[engine]) as place:
        async with asyncio.timeout(SOON_S):
            while not engine.up:
                await asyncio.sleep(0.01)
        yield place


async def speak(guest: Guest, offer: str = OFFER) -> None:
    """Offer a voice, and wait for Janus's answer."""
    await guest.told(Engine, lambda engine: engine.state == "ready")
    answered = len(guest.all(Signal))
    await guest.say(kind="description", to="up", type="offer", sdp=offer)
    await guest.until(lambda: any(signal.sender == "up" for signal in guest.all(Signal)[answered:]))


@pytest.fixture(scope="module")
def port(tmp_path_factory: pytest.TempPathFactory):
    """Of a Janus for all tests that leave it alone."""
    free = free_port()
    with janus(free, tmp_path_factory.mktemp("janus")):
        yield free


def test_each_page_has_a_line_to_janus_and_none_to_another_page(port):
    async def run() -> None:
        async with voiced(port) as place:
            ada, ben = await place.guest(), await place.guest(name="Ben")
            assert ada.welcome.engine
            await speak(ada)
            answer = ada.all(Signal)[0].signal
            assert (answer.to, answer.type) == ("up", "answer")
            assert "opus/48000" in answer.sdp
            await ada.say(kind="candidate", to="up", candidate="")
            assert not ben.all(Signal)

    asyncio.run(run())


def test_who_says_nonsense_to_a_line_gets_a_new_one_and_disturbs_nobody(port, monkeypatch):
    monkeypatch.setattr("room.server.person_voice.AGAIN_S", 0.1)

    async def run() -> None:
        async with voiced(port) as place:
            ada, ben = await place.guest(), await place.guest(name="Ben")
            await ada.told(Engine)
            await ada.say(kind="description", to="up", type="offer", sdp="v=0")
            await ada.until(lambda: [each.state for each in ada.all(Engine)] == ["ready", "away", "ready"])
            await ada.say(kind="description", to="down", type="answer", sdp="v=0")
            await speak(ada)
            await speak(ben)
            assert [each.state for each in ben.all(Engine)] == ["ready"]

    asyncio.run(run())


def test_a_moderator_mutes_a_voice_by_whatever_name_its_page_gives_it(port, monkeypatch):
    """Asked of Janus itself: a page once named its voice otherwise, and spoke on."""
    muted: list[tuple[object, object, int | None]] = []
    ask = Janus.ask

    async def told(self, handle, body, jsep=None):
        word = await ask(self, handle, body, jsep)
        if body["request"] == "moderate":
            muted.append((body["mid"], body["mute"], word.room.error_code))
        return word

    monkeypatch.setattr(Janus, "ask", told)

    async def run() -> None:
        async with voiced(port) as place:
            chair, ada = await place.guest(moderator=True), await place.guest()
            await speak(ada, OFFER.replace("a=mid:0", "a=mid:seven").replace("BUNDLE 0", "BUNDLE seven"))
            await chair.say(kind="moderate", action="mute", number=ada.number)
            async with asyncio.timeout(SOON_S):
                while not muted:
                    await asyncio.sleep(0.01)
            await chair.say(kind="moderate", action="unmute", number=ada.number)
            async with asyncio.timeout(SOON_S):
                while len(muted) < 2:
                    await asyncio.sleep(0.01)
            assert [each.state for each in ada.all(Engine)] == ["ready"]

    asyncio.run(run())
    assert muted == [("seven", True, None), ("seven", False, None)]


@pytest.mark.parametrize("more", ["m=audio 9 UDP/TLS/RTP/SAVPF 111", "m=video 9 UDP/TLS/RTP/SAVPF 96"])
def test_who_offers_more_than_one_voice_is_not_heard(more, port, monkeypatch):
    monkeypatch.setattr("room.server.person_voice.AGAIN_S", 0.1)

    async def run() -> None:
        async with voiced(port) as place:
            ada = await place.guest()
            await ada.told(Engine)
            media = OFFER[OFFER.index("m=audio") :].replace("a=mid:0", "a=mid:1")
            second = more + media[media.index("\r\n") :]
            both = OFFER.replace("BUNDLE 0", "BUNDLE 0 1") + second.replace("ssrc:1", "ssrc:2")
            await ada.say(kind="description", to="up", type="offer", sdp=both)
            await ada.until(lambda: [each.state for each in ada.all(Engine)] == ["ready", "away", "ready"])
            assert not ada.all(Signal)

    asyncio.run(run())


def test_where_janus_does_not_mute_the_line_ends(port, monkeypatch):
    monkeypatch.setattr("room.server.person_voice.AGAIN_S", 0.1)
    monkeypatch.setattr(
        "room.server.person_voice.PersonVoice._mids",
        property(lambda _: ("none",), lambda *_: None),
        raising=False,
    )

    async def run() -> None:
        async with voiced(port) as place:
            chair, ada = await place.guest(moderator=True), await place.guest()
            await chair.say(kind="moderate", action="mute", number=ada.number)
            await ada.told(Engine, lambda engine: engine.state == "away")

    asyncio.run(run())


async def _straight(port: int, requests: list[dict]) -> list[dict]:
    """What somebody hears who speaks with Janus without our server."""
    async with (
        aiohttp.ClientSession() as session,
        session.ws_connect(f"ws://127.0.0.1:{port}", protocols=("janus-protocol",)) as socket,
    ):
        answers, known = [], {}
        for request in requests:
            await socket.send_json({"transaction": secrets.token_hex(4), **known, **request})
            while (answer := await socket.receive_json(timeout=SOON_S))["janus"] == "ack":
                pass
            answers.append(answer)
            if request["janus"] in ("create", "attach") and "data" in answer:
                known["session_id" if request["janus"] == "create" else "handle_id"] = answer["data"]["id"]
        return answers


def test_nobody_gets_to_the_voices_but_by_the_server(port):
    """Without Janus's secret nobody makes anything; with it, but without the room's pin, nobody comes in."""

    async def run() -> None:
        async with voiced(port) as place:
            ada = await place.guest()
            await speak(ada)
            room = voice_room(place.keys.secret, "meeting", places=1)
            refused = await _straight(port, [{"janus": "create"}])
            assert refused[0]["error"]["code"] == 403
            join = {"request": "join", "ptype": "publisher", "room": room.number}
            own = {"apisecret": API_SECRET}
            answers = await _straight(
                port,
                [
                    {"janus": "create"} | own,
                    {"janus": "attach", "plugin": "janus.plugin.videoroom"} | own,
                    {"janus": "message", "body": join | {"pin": "guess"}} | own,
                    {"janus": "message", "body": join | {"pin": room.pin}} | own,
                ],
            )
            assert answers[2]["plugindata"]["data"]["error_code"] == 433  # unauthorized
            assert answers[3]["plugindata"]["data"]["videoroom"] == "joined"

    asyncio.run(run())


def test_janus_may_be_killed_the_page_is_told_and_gets_new_lines_when_it_is_back(tmp_path):
    async def run() -> None:
        port = free_port()
        async with AsyncExitStack() as stack:
            with janus(port, tmp_path):
                place = await stack.enter_async_context(voiced(port))
                ada, ben = await place.guest(), await place.guest(name="Ben")
                await speak(ada)
            for guest in (ada, ben):
                await guest.told(Engine, lambda engine: engine.state == "away")
            await ada.move(sequence=3)
            await ben.until(lambda: (ada.number, 3) in ben.sequences)
            cy = await place.guest(name="Cy")
            assert (await cy.told(Engine)).state == "away"
            with janus(port, tmp_path):
                for guest in (ada, ben, cy):
                    await guest.until(lambda guest=guest: guest.all(Engine)[-1].state == "ready")
                    await speak(guest)

    asyncio.run(run())


@pytest.mark.parametrize("people", [1, 7, 64])
def test_a_room_at_janus_has_a_place_for_each_person_and_moderator_twice(people):
    janus = Janus("ws://127.0.0.1:1", secret=API_SECRET)
    rooms = LiveRooms(
        b"secret",
        limits=Limits(people=people),
        relays=Relays(),
        store=AvatarStore(),
        recorder=None,
        replayed=None,
        channels=None,
        engines=[janus],
    )
    assert rooms._voices_of("lab")._room.places == 2 * (people + MOST_BEYOND)


def test_rooms_are_shared_alike_and_stay_where_they_are_when_an_instance_comes():
    instances = [Janus(f"ws://janus-{number}:8188") for number in range(4)]
    rooms = [f"room-{number}" for number in range(400)]
    before = {room: instance_of(room, instances[:3]) for room in rooms}
    after = {room: instance_of(room, instances) for room in rooms}
    assert all(60 < sum(each is instance for each in after.values()) < 140 for instance in instances)
    assert {after[room] for room in rooms if after[room] is not before[room]} == {instances[3]}
    assert before == {room: instance_of(room, instances[2::-1]) for room in rooms}
