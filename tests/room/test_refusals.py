"""What a room does not let in or passes on: strangers, floods, crowds, damaged messages, pages of other sites."""

import asyncio
import json
import time
from contextlib import suppress

import aiohttp
import pytest
from aiohttp import web

from room.errors import InputError
from room.protocol.answers import Changed, Left, Line, Notice, Refused, Welcome
from room.server import Limits, new_keys
from room.server.connection import CLOSED_BY_RULE, PARTING_S
from room.server.headers import parse_origin
from room.server.limits import BURST_S, CHATS_PER_S, NEWCOMERS_PER_S, RETURNS_PER_S, STATES_PER_S
from tests.room.guests import SOON_S, Guest, Place, meeting, open_room


@meeting
async def test_nobody_comes_in_without_the_key_of_this_room(place):
    other = Place(place.address, place.keys, "other")
    strange = new_keys()
    for key in (strange.key("meeting", "guest"), place.keys.key("other", "guest"), "0" * 22):
        guest = await place.come(key=key)
        code, words = await guest.end()
        assert code == CLOSED_BY_RULE
        assert "link" in words[0].text
        assert not guest.all(Welcome)
    await other.session.close()


@pytest.mark.parametrize(
    "first",
    [
        b"\0" * 85,
        "{}",
        "no json",
        '{"kind": "chat", "text": "hello"}',
        json.dumps({"kind": "join", "key": "k" * 22, "secret": "s" * 22, "name": "Ada", "number": 7}),
    ],
    ids=["bytes", "empty", "text", "chat", "a number of one's own"],
)
def test_what_is_no_join_ends_the_connection_with_a_word(first):
    async def run() -> None:
        async with open_room() as place:
            socket = await place.connect()
            await (socket.send_bytes(first) if isinstance(first, bytes) else socket.send_str(first))
            guest = Guest(socket, "")
            code, words = await guest.end()
            assert (code, len(words)) == (CLOSED_BY_RULE, 1)

    asyncio.run(run())


@pytest.mark.parametrize(
    "bad",
    [b"", b"\0" * 85, b"\1" * 4000, "{", '{"kind": "person"}', '{"kind": "chat", "text": "x", "number": 0}'],
    ids=["nothing", "no version", "long", "no json", "the room's own word", "a number in a text"],
)
def test_a_bad_message_ends_its_sender_alone(bad):
    async def run() -> None:
        async with open_room() as place:
            ada, ben = await place.guest(), await place.guest(name="Ben")
            await (ada.socket.send_bytes(bad) if isinstance(bad, bytes) else ada.socket.send_str(bad))
            code, words = await ada.end()
            assert (code, words[0].again) == (CLOSED_BY_RULE, False)
            await ben.move(sequence=1)
            await ben.until(lambda: ben.number in ben.states)

    asyncio.run(run())


@meeting
async def test_a_flood_ends_its_sender_with_a_word(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    for step in range(STATES_PER_S * BURST_S + 200):
        try:
            await ada.move(sequence=step)
        except (ConnectionError, aiohttp.ClientError):
            break
    code, words = await ada.end()
    assert "too many" in words[0].text
    assert code == CLOSED_BY_RULE
    await ben.move(sequence=5)
    await ben.until(lambda: ben.number in ben.states)


def test_who_is_refused_and_reads_nothing_is_cut(monkeypatch):
    """Whoever goes on to send and never reads would keep their connection for ever, and could have any number."""
    send_str = web.WebSocketResponse.send_str

    async def send_to_who_reads(self, text):
        if "removed you" in text:  # as where all buffers up to the other end are full
            await asyncio.Event().wait()
        await send_str(self, text)

    monkeypatch.setattr(web.WebSocketResponse, "send_str", send_to_who_reads)

    async def run() -> None:
        async with open_room() as place:
            ada, deaf = await place.guest(moderator=True), await place.guest(name="Deaf")
            await ada.say(kind="moderate", action="remove", number=deaf.number)
            await ada.told(Left)
            async with asyncio.timeout(PARTING_S + SOON_S):
                while not deaf.reading.done():
                    with suppress(ConnectionError):
                        await deaf.move()
                    await asyncio.sleep(0.05)
            assert deaf.all(Refused) == []

    asyncio.run(run())


@pytest.mark.parametrize("who", ["one person again and again", "ever new ones"])
def test_people_who_come_and_go_without_end_drive_nobody_out(who):
    """Each is told to all: a guest who did nothing else would fill the queues of those with slow networks."""

    async def run() -> None:
        async with open_room(limits=Limits(people=8)) as place:
            ada = await place.guest()
            refused = []
            one = who.startswith("one")
            begun = time.monotonic()
            for number in range(50):
                secret = "s" * 22 if one else f"{number:022}"
                storm = await place.come(name="Storm", secret=secret)
                await storm.until(lambda storm=storm: storm.answers)
                refused += storm.all(Refused)
                if not storm.all(Refused) and not one:
                    await storm.say(kind="leave")
                    await storm.end()
                await storm.go()
            # as many as may come in while this machine takes its time
            rate, burst = (RETURNS_PER_S, RETURNS_PER_S * BURST_S) if one else (NEWCOMERS_PER_S, 2 * 8)
            assert len(refused) >= 50 - 2 - burst - rate * (time.monotonic() - begun)
            assert {(word.text, word.again) for word in refused} <= {
                ("too many come in at once; wait a moment", True)
            }
            await place.guest(name="Chair", moderator=True)
            await ada.told(Changed, lambda changed: changed.person.name == "Chair")

    asyncio.run(run())


@meeting
async def test_chat_that_is_too_fast_is_not_sent(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    count = CHATS_PER_S * BURST_S + 50
    for line in range(count):
        await ada.say(kind="chat", text=str(line))
    await ada.told(Notice)
    await ada.say(kind="voice", open=True)
    await ben.told(Changed, lambda changed: changed.person.voice)
    assert len(ben.all(Line)) < count


@meeting
async def test_a_large_text_is_refused_by_its_length(place):
    ada = await place.guest()
    await ada.socket.send_str("x" * 100_000)
    await ada.end()
    assert ada.socket.close_code == aiohttp.WSCloseCode.MESSAGE_TOO_BIG


def test_rooms_and_places_are_bounded():
    async def run() -> None:
        async with open_room(limits=Limits(people=2, rooms=1)) as place:
            await place.guest()
            await place.guest(name="Ben")
            assert "full" in (await (await place.come(name="Cy")).end())[1][0].text
            other = Place(place.address, place.keys, "other")
            assert "in use" in (await (await other.come(name="Cy")).end())[1][0].text
            await other.session.close()

    asyncio.run(run())


@pytest.mark.parametrize(
    ("typed", "origin"),
    [
        ("https://rooms.example", "https://rooms.example"),
        ("https://rooms.example/", "https://rooms.example"),
        ("HTTPS://Rooms.Example:8443/", "https://rooms.example:8443"),
        ("https://rooms.example:443", "https://rooms.example"),
        ("http://[::1]:8443", "http://[::1]:8443"),
        ("http://[::80]", "http://[::80]"),
    ],
)
def test_an_origin_is_kept_as_browsers_name_it(typed, origin):
    assert parse_origin(typed) == origin


@pytest.mark.parametrize(
    "typed",
    [
        *("", "rooms.example", "rooms.example:8443", "//rooms.example", "wss://rooms.example", "https://"),
        *("https://rooms.example/room", "https://rooms.example?", "https://rooms.example#a", "https://["),
        *("https://a@rooms.example", "https://rooms.example:99999", "https://rooms.example:", "https://a b"),
    ],
)
def test_an_origin_that_is_none_is_refused(typed):
    with pytest.raises(InputError, match="https://HOST is one"):
        parse_origin(typed)


@pytest.mark.parametrize(
    ("origin", "status"),
    [
        (None, 101),
        ("{own}", 101),
        ("https://rooms.example", 101),
        ("https://evil.example", 403),
        ("null", 403),
        ("http://rooms.example", 403),
        ("http://[", 403),
    ],
)
def test_pages_of_other_sites_may_not_come_in(origin, status):
    async def run() -> None:
        async with open_room(origins=frozenset({"https://rooms.example"})) as place:
            headers = {"Origin": origin.format(own=place.address)} if origin else {}
            if status == 101:
                await (await place.connect(headers=headers)).close()
            else:
                with pytest.raises(aiohttp.WSServerHandshakeError, match=str(status)):
                    await place.connect(headers=headers)

    asyncio.run(run())
