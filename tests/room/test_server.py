"""A room as people meet it, over real WebSockets: who comes in, who hears of what, and what nobody may do."""

import asyncio
import json
import time
from collections.abc import Callable, Coroutine
from contextlib import suppress
from functools import wraps

import aiohttp
import pytest
from aiohttp import web
from yarl import URL

from room.protocol.texts import Changed, Door, Left, Line, Notice, Refused, Signal, Welcome
from room.server import Limits, Relays, new_keys
from room.server.application import STATIC
from room.server.connection import CLOSED_BY_RULE, PARTING_S
from room.server.limits import BURST_S, CHATS_PER_S, STATES_PER_S, Bucket
from room.state import identity
from tests.room.guests import Guest, Place, open_room


def meeting(scenario: Callable[[Place], Coroutine]) -> Callable[[], None]:
    """Run a scenario in a room of its own."""

    @wraps(scenario)
    def test() -> None:
        async def run() -> None:
            async with open_room() as place:
                await scenario(place)

        asyncio.run(run())

    del test.__wrapped__  # pytest reads arguments through it, and would look for a fixture
    return test


WEIGHTS = tuple(step / 255 for step in range(52))


@meeting
async def test_two_people_see_each_other_move(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    assert {person.name for person in ben.welcome.people} == {"Ada", "Ben"}
    changed = await ada.told(Changed)
    assert (changed.person.name, changed.person.number) == ("Ben", ben.number)
    await ada.move(weights=WEIGHTS, floor_m=(1.5, -2.0), sequence=7)
    await ben.until(lambda: ada.number in ben.states)
    seen = ben.states[ada.number]
    assert (seen.weights, seen.floor_m, seen.sequence) == (WEIGHTS, (1.5, -2.0), 7)


@meeting
async def test_who_comes_late_gets_the_roster_and_the_last_states(place):
    ada = await place.guest()
    await ada.move(heading=1.0)
    await ada.until(lambda: ada.number in ada.states)
    ben = await place.guest(name="Ben")
    await ben.until(lambda: ada.number in ben.states)
    assert ben.states[ada.number].heading == pytest.approx(1.0, abs=1e-4)


@meeting
async def test_all_get_one_tick_for_many_states_and_none_when_nobody_moves(place):
    guests = [await place.guest(name=f"Guest {index}") for index in range(4)]
    start, before = time.monotonic(), guests[0].ticks
    for step in range(30):
        for guest in guests:
            await guest.move(sequence=step)
        await asyncio.sleep(1 / 30)
    await guests[0].until(lambda: len(guests[0].states) == 4)
    ticks, seconds = guests[0].ticks - before, time.monotonic() - start
    assert ticks <= 30 * seconds + 2, "one buffer a tick, however many people move"
    await guests[0].until(lambda: len(guests[0].sequences) == 120)
    assert sorted(guests[0].sequences) == [(guest.number, step) for guest in guests for step in range(30)], (
        "none is lost"
    )
    quiet = guests[0].ticks
    await asyncio.sleep(0.3)
    assert guests[0].ticks - quiet <= 1


@meeting
async def test_who_comes_back_has_the_same_number_and_stands_where_they_stood(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    await ada.move(floor_m=(3.0, 4.0))
    await ben.until(lambda: ada.number in ben.states)
    await ada.go()
    await ben.told(
        Changed, lambda changed: changed.person.number == ada.number and not changed.person.present
    )
    again = await place.guest(secret=ada.secret)
    assert (again.number, again.welcome.id) == (ada.number, ada.welcome.id)
    await again.until(lambda: again.number in again.states)
    assert again.states[again.number].floor_m == (3.0, 4.0)
    assert ada.welcome.id == identity(ada.secret) != ada.secret


@meeting
async def test_who_leaves_is_gone_at_once(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    await ada.say(kind="leave")
    assert (await ben.told(Left)).number == ada.number
    assert [person.name for person in (await place.guest(name="Cy")).welcome.people] == ["Ben", "Cy"]


@meeting
async def test_a_second_window_takes_the_place_of_the_first(place):
    ada = await place.guest()
    again = await place.guest(secret=ada.secret)
    code, words = await ada.end()
    assert code == CLOSED_BY_RULE
    assert not words[0].again
    assert len(again.welcome.people) == 1


@meeting
async def test_a_program_moves_the_face_and_nothing_else_and_gives_it_back(place):
    ben, ada = await place.guest(name="Ben"), await place.guest()
    await ada.move(flags=1, floor_m=(2.0, 2.0), animation=1, weights=(0.2,) * 52)
    program = await place.guest(secret=ada.secret, role="face")
    await program.move(flags=2, floor_m=(9.0, 9.0), animation=5, weights=WEIGHTS, gaze=(0.1,) * 4)
    changed = await ben.told(Changed, lambda changed: changed.person.face == "program")
    assert changed.person.number == ada.number
    await ben.until(lambda: ada.number in ben.states and ben.states[ada.number].weights == WEIGHTS)
    seen = ben.states[ada.number]
    assert (seen.flags, seen.floor_m, seen.animation) == (3, (2.0, 2.0), 1)
    assert seen.gaze[0] == pytest.approx(0.1, abs=0.005)
    await program.go()
    await ben.told(Changed, lambda changed: changed.person.face == "page")
    await ada.move(weights=(0.2,) * 52)
    await ben.until(lambda: ben.states[ada.number].weights[0] == 0.2)


@meeting
async def test_chat_and_calls_go_to_whom_they_are_for(place):
    ada, ben, cy = await place.guest(), await place.guest(name="Ben"), await place.guest(name="Cy")
    await ada.say(kind="chat", text="<b>hello</b>")
    for guest in (ada, ben, cy):
        assert (await guest.told(Line)).text == "<b>hello</b>"
    await ada.say(kind="description", to=ben.number, type="offer", sdp="v=0")
    signal = await ben.told(Signal)
    assert (signal.sender, signal.signal.sdp) == (ada.number, "v=0")
    await ada.say(kind="candidate", to=999, candidate="")
    await ada.say(kind="voice", open=True)
    assert (await cy.told(Changed, lambda changed: changed.person.voice)).person.number == ada.number
    assert not cy.all(Signal)


@meeting
async def test_a_moderator_mutes_removes_and_locks(place):
    chair, ada, ben = await place.guest(moderator=True), await place.guest(), await place.guest(name="Ben")
    assert chair.welcome.moderator
    await chair.say(kind="moderate", action="mute", number=ada.number)
    await ben.told(Changed, lambda changed: changed.person.muted)
    await ada.move(flags=1 | 2)
    await ben.until(lambda: ada.number in ben.states)
    assert ben.states[ada.number].flags == 2, "who is muted has no speaking sign"
    await ada.say(kind="chat", text="still here")
    assert "muted" in (await ada.told(Notice)).text
    await chair.say(kind="moderate", action="remove", number=ada.number)
    assert (await ada.end())[1][0].text == "a moderator has removed you from this room"
    assert (await ben.told(Left)).number == ada.number
    back = await place.come(secret=ada.secret)
    assert not (await back.end())[1][0].again
    await chair.say(kind="moderate", action="lock")
    await ben.told(Door, lambda door: door.locked)
    assert "locked" in (await (await place.come(name="Cy")).end())[1][0].text
    await ben.go()
    assert (await place.guest(secret=ben.secret)).number == ben.number, (
        "a lock keeps nobody's own place from them"
    )


@pytest.mark.parametrize("action", ["mute", "unmute", "unshare", "remove", "lock", "unlock"])
def test_a_guest_moderates_nobody(action):
    async def run() -> None:
        async with open_room() as place:
            ada, ben = await place.guest(), await place.guest(name="Ben")
            await ada.say(kind="moderate", action=action, number=ben.number)
            assert "moderator" in (await ada.told(Notice)).text
            assert not ben.all(Left) + ben.all(Door) + ben.all(Refused)

    asyncio.run(run())


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
            async with asyncio.timeout(PARTING_S + 5):
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
            for number in range(50):
                secret = "s" * 22 if who.startswith("one") else f"{number:022}"
                storm = await place.come(name="Storm", secret=secret)
                await storm.until(lambda storm=storm: storm.answers)
                refused += storm.all(Refused)
                if not storm.all(Refused) and not who.startswith("one"):
                    await storm.say(kind="leave")
                    await storm.end()
                await storm.go()
            assert len(refused) > 10
            assert {(word.text, word.again) for word in refused} == {
                ("too many come in at once; wait a moment", True)
            }
            await place.guest(name="Chair", moderator=True)
            await ada.told(Changed, lambda changed: changed.person.name == "Chair")

    asyncio.run(run())


@meeting
async def test_chat_that_is_too_fast_is_not_sent(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    for line in range(CHATS_PER_S * BURST_S + 5):
        await ada.say(kind="chat", text=str(line))
    await ada.told(Notice)
    await ada.say(kind="voice", open=True)
    await ben.told(Changed, lambda changed: changed.person.voice)
    assert len(ben.all(Line)) < CHATS_PER_S * BURST_S + 5


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


@meeting
async def test_every_answer_has_the_policy_of_contents(place):
    for path in ("/", "/health", "/room/meeting", "/room/..%2f", "/nothing", "/static/../keys.py"):
        async with place.session.get(place.address + path) as answer:
            policy = answer.headers["Content-Security-Policy"]
            assert "default-src 'none'" in policy
            assert "unsafe-inline" not in policy
            assert "'unsafe-eval'" not in policy
            assert answer.headers["Referrer-Policy"] == "no-referrer"


@meeting
async def test_operators_see_numbers_and_no_names(place):
    ada = await place.guest(name="Adelheid")
    await ada.move()
    await ada.until(lambda: ada.states)
    async with place.session.get(f"{place.address}/metrics") as answer:
        text = await answer.text()
    values = dict(line.split(" ") for line in text.splitlines() if not line.startswith("#"))
    assert (values["room_people"], values["room_rooms"], values["room_states_total"]) == ("1", "1", "1")
    assert "room_late_seconds_total" in values
    assert "Adelheid" not in text
    assert "meeting" not in text
    async with place.session.get(f"{place.address}/health") as answer:
        assert (answer.status, await answer.text()) == (200, "well\n")


def test_a_relay_gets_credentials_that_end():
    async def run() -> None:
        relays = Relays(stun=("stun:a:1",), turn=("turn:b:2",), secret="north")
        async with open_room(relays=relays) as place:
            stun, turn = (await place.guest()).welcome.ice
            assert stun.urls == ("stun:a:1",)
            until, _, person = turn.username.partition(":")
            assert 11 * 3600 < int(until) - time.time() < 13 * 3600
            assert len(person) == 16

    asyncio.run(run())
    # a second opinion (printf 43200:u | openssl dgst -sha1 -hmac north -binary | base64)
    made = Relays(turn=("turn:b:2",), secret="north").servers("u", now_s=0)[0]
    assert (made.username, made.credential) == ("43200:u", "/OPIxHbL4qrWWh2PvVXUnjR2s88=")


def test_a_bucket_allows_a_rate_and_a_burst():
    bucket = Bucket(2, burst=4)
    assert [bucket.take(now=0) for _ in range(5)] == [True] * 4 + [False]
    assert [bucket.take(now=1) for _ in range(3)] == [True, True, False]
    assert [bucket.take(now=100) for _ in range(5)] == [True] * 4 + [False]


@meeting
async def test_files_are_served_whole_compressed_and_no_others(place):
    script = place.address + "/static/room.js"
    async with place.session.get(script, headers={"Accept-Encoding": "identity"}) as answer:
        plain = await answer.read()
        assert answer.headers["Content-Type"].startswith("text/javascript")
        tag = answer.headers["ETag"]
    assert plain == (STATIC / "room.js").read_bytes()
    async with place.session.get(script, headers={"Accept-Encoding": "gzip"}) as answer:
        assert int(answer.headers["Content-Length"]) < len(plain) / 3
        assert await answer.read() == plain
    async with place.session.get(script, headers={"If-None-Match": tag}) as answer:
        assert (answer.status, await answer.read()) == (304, b"")
    for path in (
        "../keys.py",
        "..%2fkeys.py",
        "%2e%2e/keys.py",
        "/etc/passwd",
        "nothing.js",
        "avatars",
        ".",
        "",
    ):
        async with place.session.get(URL(f"{place.address}/static/{path}", encoded=True)) as answer:
            assert answer.status == 404, path
    async with place.session.get(place.address + "/avatars.json") as answer:
        assert await answer.json() == sorted(path.stem for path in (STATIC / "avatars").glob("*.glb"))
