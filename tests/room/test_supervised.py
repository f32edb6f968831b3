"""A server whose jobs fail: it ends, and says why, in place of going on without them."""

import asyncio
from contextlib import suppress
from functools import partial

import pytest

from room.errors import NotAllowed
from room.server import Limits, Relays, Rooms, new_keys
from room.server.janus import Janus
from room.server.live_room import LiveRoom
from room.server.serve import Address, serve
from room.server.supervised import supervised
from tests.room.guests import Place


def test_jobs_end_with_the_context():
    async def run() -> list[str]:
        heard: list[str] = []

        async def job() -> None:
            try:
                await asyncio.Event().wait()
            finally:
                heard.append("ended")

        async with supervised(job, job, failed=partial(heard.append, "failed")):
            await asyncio.sleep(0)
        return heard

    assert asyncio.run(run()) == ["ended", "ended"]


def test_a_tick_that_fails_ends_the_server(monkeypatch: pytest.MonkeyPatch):
    def tick(room: LiveRoom, *, now: float) -> None:
        raise ZeroDivisionError("a fault of ours")

    monkeypatch.setattr(LiveRoom, "tick", tick)
    keys = new_keys()
    coming: list[asyncio.Task[None]] = []
    late: list[str] = []
    rooms = Rooms(keys, limits=Limits(), relays=Relays())

    async def come(address: str) -> None:
        place = Place(address, keys)
        try:
            await (await place.come()).reading
        finally:
            await place.session.close()

    def give_up() -> None:
        late.append("the server went on without ticks")
        rooms.stopped.set()

    def started(address: str) -> None:
        coming.append(asyncio.get_running_loop().create_task(come(address)))
        asyncio.get_running_loop().call_later(120, give_up)

    with pytest.raises(ZeroDivisionError, match="a fault of ours"):
        serve(rooms, Address(port=0), started=started)
    assert not late


def test_a_room_that_cannot_be_opened_leaves_nothing_at_its_engine(monkeypatch: pytest.MonkeyPatch):
    async def open_(room: LiveRoom) -> None:
        raise NotAllowed("this room cannot be reached", again=True)

    monkeypatch.setattr(LiveRoom, "open", open_)

    async def run() -> int:
        engine = Janus("ws://127.0.0.1:9")
        rooms = Rooms(new_keys(), limits=Limits(), relays=Relays(), engines=[engine])
        for _ in range(3):
            with pytest.raises(NotAllowed):
                await rooms._live_rooms.open("meeting")
        return len(engine.watchers)

    assert asyncio.run(run()) == 0


def test_a_job_that_swallows_a_cancellation_is_ended_by_the_next():
    ends = []

    async def job() -> None:
        for end in ("swallowed", "heard"):
            with suppress(asyncio.CancelledError):
                await asyncio.sleep(60)
            ends.append(end)

    async def run() -> None:
        async with asyncio.timeout(50), supervised(job, failed=lambda: ends.append("failed")):
            await asyncio.sleep(0)

    asyncio.run(run())
    assert ends == ["swallowed", "heard"]
