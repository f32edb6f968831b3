"""One room at several servers, over a real Redis: people notice nothing of it, and Redis may go and come."""

import asyncio
import json
import time
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import AsyncExitStack, asynccontextmanager
from functools import wraps

import pytest

from room.avatars.pieces import PIECE_BYTES
from room.protocol.answers import Changed, Door, Left, Line, Notice, Signal
from room.server import Keys, Limits, new_keys
from room.server.connection import CLOSED_BY_RULE
from room.server.peer_processes import AGAIN_S
from room.server.redis_channels import RedisChannels
from tests.room.avatars import avatar
from tests.room.engines import free_port, needs_redis, redis, started
from tests.room.guests import SOON_S, Guest, Place, open_room

pytestmark = needs_redis


@pytest.fixture(scope="module")
def port():
    """Of a Redis for all tests that leave it alone."""
    free = free_port()
    with redis(free):
        yield free


@asynccontextmanager
async def server(port: int, keys: Keys, limits: Limits | None = None) -> AsyncIterator[Place]:
    """One of several servers, with a part in Redis."""
    channels = RedisChannels(f"redis://127.0.0.1:{port}/0", secret=keys.secret)
    async with open_room(keys=keys, channels=channels, limits=limits) as place:
        async with asyncio.timeout(SOON_S):
            while not channels.connected:
                await asyncio.sleep(0.01)
        place.channels = channels
        yield place


def two_servers(scenario: Callable[[Place, Place], Coroutine]) -> Callable[[int], None]:
    """Run a scenario in one room of two servers."""

    @wraps(scenario)
    def test(port: int) -> None:
        async def run() -> None:
            keys = new_keys()
            async with server(port, keys) as north, server(port, keys) as south:
                await scenario(north, south)

        asyncio.run(run())

    del test.__wrapped__
    return test


@two_servers
async def test_people_of_two_servers_see_each_other_move(north, south):
    ada = await north.guest()
    ben = await south.guest(name="Ben")
    assert {person.name for person in ben.welcome.people} == {"Ada", "Ben"}, (
        "who is there is known at the door"
    )
    assert ada.number != ben.number
    changed = await ada.told(Changed, lambda changed: changed.person.name == "Ben")
    assert changed.person.number == ben.number
    for step in range(30):
        await ada.move(sequence=step, floor_m=(1.0, -2.0))
        await ben.move(sequence=step)
        await asyncio.sleep(1 / 30)
    for guest, other in ((ada, ben), (ben, ada)):
        await guest.until(lambda guest=guest, other=other: (other.number, 29) in guest.sequences)
        seen = [sequence for number, sequence in guest.sequences if number == other.number]
        assert seen == list(range(30)), "none is lost, and none comes twice"
    assert ben.states[ada.number].floor_m == (1.0, -2.0)


@two_servers
async def test_who_comes_late_by_another_server_sees_where_all_stand(north, south):
    ada = await north.guest()
    await ada.move(floor_m=(3.0, 4.0))
    await ada.until(lambda: ada.number in ada.states)
    ben = await south.guest(name="Ben")
    await ben.until(lambda: ada.number in ben.states)
    assert ben.states[ada.number].floor_m == (3.0, 4.0)


@two_servers
async def test_who_comes_back_by_another_server_is_the_same_and_stands_where_they_stood(north, south):
    ada, ben, cy = await north.guest(), await south.guest(name="Ben"), await north.guest(name="Cy")
    await ada.move(floor_m=(3.0, 4.0))
    await ben.until(lambda: ada.number in ben.states)
    await ada.go()
    await ben.told(Changed, lambda changed: not changed.person.present)
    again = await south.guest(secret=ada.secret)
    assert (again.number, again.welcome.id) == (ada.number, ada.welcome.id)
    await again.until(lambda: again.number in again.states)
    assert again.states[again.number].floor_m == (3.0, 4.0)
    await again.move(floor_m=(5.0, 4.0))
    await ben.until(lambda: ben.states[ada.number].floor_m == (5.0, 4.0))
    # a page that is told of a place at once moves at once, and nobody misses it
    await cy.until(lambda: cy.states[ada.number].floor_m == (5.0, 4.0))
    back = await north.guest(secret=ada.secret)
    assert back.number == ada.number
    assert (await again.end())[1][0].text == "you came in from another window"
    await back.move(floor_m=(6.0, 4.0))
    await ben.until(lambda: ben.states[ada.number].floor_m == (6.0, 4.0))
    assert not ben.all(Left)


@two_servers
async def test_chat_and_calls_cross_servers(north, south):
    ada, ben, cy = await north.guest(), await south.guest(name="Ben"), await south.guest(name="Cy")
    await ada.told(Changed, lambda changed: changed.person.name == "Cy")
    await ada.say(kind="chat", text="hello")
    for guest in (ada, ben, cy):
        assert (await guest.told(Line)).text == "hello"
    await ada.say(kind="description", to=ben.number, type="offer", sdp="v=0")
    signal = await ben.told(Signal)
    assert (signal.sender, signal.signal.sdp) == (ada.number, "v=0")
    await ada.say(kind="voice", open=True)
    assert (await cy.told(Changed, lambda changed: changed.person.voice)).person.number == ada.number
    assert not cy.all(Signal)
    assert len(ben.all(Line)) == 1


@two_servers
async def test_who_shares_is_known_at_another_server_before_the_call(north, south):
    ada, ben = await north.guest(), await south.guest(name="Ben")
    await ada.told(Changed, lambda changed: changed.person.name == "Ben")
    for on in (True, False, True):  # whatever the last account was before
        await ada.say(kind="share", on=on)
    await ada.say(kind="description", plane="screen", to=ben.number, type="offer", sdp="v=0")
    signal = await ben.told(Signal)
    told = [
        answer.person.shares
        for answer in ben.answers[: ben.answers.index(signal)]
        if isinstance(answer, Changed)
    ]
    assert told[-1]


@two_servers
async def test_a_moderator_of_one_server_mutes_removes_and_locks_at_the_other(north, south):
    chair, ada, ben = await north.guest(moderator=True), await south.guest(), await south.guest(name="Ben")
    await chair.told(Changed, lambda changed: changed.person.name == "Ben")
    await chair.say(kind="moderate", action="mute", number=ada.number)
    await ada.told(Changed, lambda changed: changed.person.muted)
    await ada.move(flags=3)
    for guest in (chair, ben):
        await guest.until(lambda guest=guest: ada.number in guest.states)
        assert guest.states[ada.number].flags == 2, "who is muted has no speaking sign, at no server"
    await ada.say(kind="chat", text="still here")
    assert "muted" in (await ada.told(Notice)).text
    await chair.say(kind="moderate", action="remove", number=ada.number)
    code, words = await ada.end()
    assert (code, words[0].text) == (CLOSED_BY_RULE, "a moderator has removed you from this room")
    assert (await ben.told(Left)).number == ada.number
    for place in (north, south):
        assert not (await (await place.come(secret=ada.secret)).end())[1][0].again
    await chair.say(kind="moderate", action="lock")
    await ben.told(Door, lambda door: door.locked)
    assert "locked" in (await (await south.come(name="Cy")).end())[1][0].text


@two_servers
async def test_a_lock_holds_at_a_server_that_has_not_heard_of_the_room(north, south):
    chair = await north.guest(moderator=True)
    await chair.say(kind="moderate", action="lock")
    await chair.told(Door)
    assert "locked" in (await (await south.come()).end())[1][0].text


@two_servers
async def test_a_program_at_another_server_moves_the_face_and_gives_it_back(north, south):
    ada, ben = await north.guest(), await south.guest(name="Ben")
    await ada.move(floor_m=(2.0, 2.0), weights=(0.2,) * 52)
    await ben.until(lambda: ada.number in ben.states)
    program = await south.guest(secret=ada.secret, role="face")
    await program.move(flags=2, floor_m=(9.0, 9.0), weights=(0.6,) * 52)
    for guest in (ada, ben):
        await guest.told(Changed, lambda changed: changed.person.face == "program")
        await guest.until(lambda guest=guest: guest.states[ada.number].weights[0] == 0.6)
        assert guest.states[ada.number].floor_m == (2.0, 2.0)
    await program.go()
    for _ in range(50):
        await ada.move(weights=(0.2,) * 52)
        await asyncio.sleep(1 / 30)
    for guest in (ada, ben):
        await guest.until(lambda guest=guest: guest.states[ada.number].weights[0] == 0.2)


def test_who_comes_before_redis_has_answered_waits_for_it(port):
    """A server says its address and hears Redis a moment later; no page is sent away between the two."""

    async def run() -> None:
        channels = RedisChannels(f"redis://127.0.0.1:{port}/0", secret=new_keys().secret)
        async with channels.running(failed=lambda: None):
            assert not channels.connected
            await channels.join("meeting", lambda _: None)
            assert channels.connected

    asyncio.run(run())


def test_places_are_counted_over_all_servers(port):
    async def run() -> None:
        keys = new_keys()
        limits = Limits(people=2)
        async with server(port, keys, limits) as north, server(port, keys, limits) as south:
            ada = await north.guest()
            await south.guest(name="Ben")
            await ada.told(Changed)  # two who come at one moment by two servers may both get the last place
            assert "full" in (await (await north.come(name="Cy")).end())[1][0].text

    asyncio.run(run())


def test_servers_of_other_keys_have_other_rooms(port):
    async def run() -> None:
        async with server(port, new_keys()) as north, server(port, new_keys()) as south:
            await north.guest()
            assert [person.name for person in (await south.guest(name="Ben")).welcome.people] == ["Ben"]

    asyncio.run(run())


def test_people_of_a_server_that_is_killed_are_away_and_come_back_by_another(port, monkeypatch):
    monkeypatch.setattr("room.server.peer_processes.SILENT_S", 2.5)

    async def run() -> None:
        keys = new_keys()
        async with AsyncExitStack() as stack:
            south = await stack.enter_async_context(server(port, keys))
            north = await stack.enter_async_context(server(port, keys))
            ada, ben = await north.guest(), await south.guest(name="Ben")
            await ada.move(floor_m=(3.0, 4.0))
            await ben.until(lambda: ada.number in ben.states)
            north.channels.say = lambda room, content: None  # as a process that is killed: no word any more
            await ben.told(Changed, lambda changed: not changed.person.present)
            again = await south.guest(secret=ada.secret)
            assert again.number == ada.number
            assert not ben.all(Left)

    asyncio.run(run())


def test_redis_may_be_killed_and_nobody_is_driven_out():
    """Each server goes on by itself; when Redis is back, all see each other again, and what moderators did holds."""

    async def run() -> None:
        port, keys = free_port(), new_keys()
        async with AsyncExitStack() as stack:
            with redis(port):
                north = await stack.enter_async_context(server(port, keys))
                south = await stack.enter_async_context(server(port, keys))
                ada, ben = await north.guest(moderator=True), await south.guest(name="Ben")
                cy = await north.guest(name="Cy")
                await ada.told(Changed, lambda changed: changed.person.name == "Ben")
            await cy.move(sequence=1)
            await ada.until(lambda: (cy.number, 1) in ada.sequences)  # those of one server see each other
            await ada.say(kind="moderate", action="lock")
            await ada.say(kind="moderate", action="remove", number=ben.number)
            await ada.told(Left)
            away = Place(south.address, keys, "other")
            refused = (await (await away.come()).end())[1][0]
            assert refused.again, "a room that cannot be looked at is not opened; the page tries again"
            assert not ben.socket.closed
            with redis(port):
                start = time.monotonic()
                assert "removed" in (await ben.end())[1][0].text
                dan = await south.come(name="Dan")
                assert "locked" in (await dan.end())[1][0].text
                eve = await south.guest(name="Eve", moderator=True)
                await eve.until(lambda: len(eve.welcome.people) == 3)
                await cy.move(sequence=2)
                await eve.until(lambda: (cy.number, 2) in eve.sequences)
                print(f"whole again {time.monotonic() - start:.1f} s after Redis")
                assert time.monotonic() - start < 20, "4 on a machine that does nothing else"
            await away.session.close()

    asyncio.run(run())


def test_a_room_that_is_flooded_pushes_nothing_of_another_out(port):
    async def run() -> None:
        async with server(port, new_keys()) as north:
            heard: list[bytes] = []
            await north.channels.join("calm", heard.append)
            north.channels.say("calm", b"a word")
            for _ in range(3000):
                north.channels.say("loud", b"noise")
            async with asyncio.timeout(SOON_S):
                while not heard:
                    await asyncio.sleep(0.01)
            assert heard == [b"a word"]

    asyncio.run(run())


def test_a_redis_that_takes_no_password_is_said_to_do_so():
    free, said = free_port(), []

    async def run() -> None:
        channels = RedisChannels(f"redis://:guess@127.0.0.1:{free}/0", secret=b"s", said=said.append)
        async with channels.running(failed=pytest.fail), asyncio.timeout(SOON_S):
            while not any("password" in each for each in said):
                await asyncio.sleep(0.05)

    command = (
        "redis-server",
        "--port",
        str(free),
        "--bind",
        "127.0.0.1",
        "--save",
        "",
        "--requirepass",
        "north",
    )
    with started(*command, port=free):
        asyncio.run(run())
    assert len(said) == 1


def test_a_message_that_is_none_is_let_alone(port):
    async def run() -> None:
        keys = new_keys()
        async with server(port, keys) as north:
            ada = await north.guest()
            channels = north.channels
            for content in (
                b"",
                b"{",
                b"\1",
                b"\2" + b"f" * 16 + b"\0" * 8,
                b'{"kind":"account"}',
                b"x" * 2_000_000,
            ):
                await channels.ask("meeting", content)
            await ada.move(sequence=5)
            await ada.until(lambda: (ada.number, 5) in ada.sequences)

    asyncio.run(run())


async def avatar_at(place: Place, digest: str) -> tuple[int, bytes]:
    """What a page gets that asks its own server for somebody's avatar."""
    address = f"{place.address}/room/{place.name}/avatar/{digest}"
    bearer = {"Authorization": f"Bearer {place.keys.key(place.name, 'guest')}"}
    async with place.session.get(address, headers=bearer) as answer:
        return answer.status, await answer.read()


async def bring(place: Place, guest: Guest, content: bytes) -> str:
    bearer = {"Authorization": f"Bearer {place.keys.key(place.name, 'guest')}.{guest.secret}"}
    address = f"{place.address}/room/{place.name}/avatar"
    async with place.session.post(address, data=content, headers=bearer) as answer:
        assert answer.status == 200, await answer.text()
        return (await answer.json())["own"]


def wears(name: str, digest: str) -> Callable[[Changed], bool]:
    return lambda changed: (changed.person.name, changed.person.own) == (name, digest)


LARGE = avatar(lambda made: made.update(extras="x" * 600_000))
"""Of three pieces."""


@two_servers
async def test_an_avatar_is_carried_once_to_who_looks_from_another_server(north, south):
    ada, ben = await north.guest(), await south.guest(name="Ben")
    digest = await bring(north, ada, LARGE)
    await ben.told(Changed, wears("Ada", digest))
    asked: list[tuple[str, bytes]] = []
    say = south.channels.say
    south.channels.say = lambda room, content: (asked.append((room, content)), say(room, content))
    both = await asyncio.gather(avatar_at(south, digest), avatar_at(south, digest))
    assert both == [(200, LARGE)] * 2
    assert await avatar_at(south, digest) == (200, LARGE)
    wanted = [json.loads(content)["at"] for _, content in asked if b'"wanted"' in content]
    assert wanted == [0, PIECE_BYTES, 2 * PIECE_BYTES], "each piece once, for all who ask"
    assert (await avatar_at(south, "0" * 64))[0] == 404
    await ada.say(kind="leave")
    await ben.told(Left)
    async with asyncio.timeout(SOON_S):  # until it is forgotten
        while [(await avatar_at(place, digest))[0] for place in (north, south)] != [404, 404]:
            await asyncio.sleep(0.05)


@two_servers
async def test_a_moderator_of_another_server_takes_an_avatar_off(north, south):
    ada, chair = await north.guest(), await south.guest(name="Chair", moderator=True)
    digest = await bring(north, ada, avatar())
    await chair.told(Changed, wears("Ada", digest))
    await chair.say(kind="moderate", action="undress", number=ada.number)
    await ada.told(Changed, lambda changed: changed.person.number == ada.number and not changed.person.own)
    await asyncio.sleep(2 * AGAIN_S)
    assert chair.all(Changed)[-1].person.own == ""
    assert (await avatar_at(south, digest))[0] == 404
    await chair.say(kind="moderate", action="mute", number=ada.number)
    await ada.told(Changed, lambda changed: changed.person.muted)
    await ada.say(kind="leave")
    await chair.told(Left)
    for place in (north, south):
        again = await place.guest(secret=ada.secret)
        assert [person.muted for person in again.welcome.people if person.number == again.number] == [True]
        with pytest.raises(AssertionError, match="a moderator has taken your own avatar off"):
            await bring(place, again, avatar())


@two_servers
async def test_who_goes_on_to_another_server_brings_the_avatar_again(north, south):
    ada, ben = await north.guest(), await south.guest(name="Ben")
    digest = await bring(north, ada, avatar())
    await ben.told(Changed, wears("Ada", digest))
    again = await south.guest(secret=ada.secret)
    (own,) = {person.own for person in again.welcome.people if person.number == again.number}
    assert own == "", "their page hears that this server has it not"
    assert await bring(south, again, avatar()) == digest
    await ben.told(Changed, wears("Ada", digest))
    assert await avatar_at(south, digest) == (200, avatar())


@two_servers
async def test_what_is_no_avatar_is_carried_to_nobody(north, south):
    ada, ben = await north.guest(), await south.guest(name="Ben")
    digest = await bring(north, ada, avatar())
    await ben.told(Changed, wears("Ada", digest))
    say = north.channels.say

    def forge(room: str, content: bytes) -> None:
        say(room, content[:-1] + b"?" if room.startswith("/") and content[:1] == b"\3" else content)

    north.channels.say = forge
    assert (await avatar_at(south, digest))[0] == 404
