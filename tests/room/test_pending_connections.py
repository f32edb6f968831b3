"""Connections that say nothing give way to those who come."""

import asyncio

import pytest
from aiohttp import WSMsgType
from hypothesis import given
from hypothesis import strategies as st

from room.server.pending_connections import PendingConnections
from tests.hanging_up import hang_up
from tests.room.guests import SOON_S, open_room

HOSTS = ["192.0.2.1", "192.0.2.2", "2001:db8::1", "2001:db8::2", "2001:db8:0:1::1", None]


@given(st.lists(st.sampled_from(HOSTS), max_size=60))
def test_never_more_than_so_many_and_a_crowd_cuts_its_own_oldest(hosts):
    pending, standing = PendingConnections(most=8), []
    for index, host in enumerate(hosts):
        before = list(standing)
        pending.add(host, lambda index=index: standing.remove(index))
        cut = [each for each in before if each not in standing]
        standing.append(index)
        assert len(standing) <= 8
        for each in cut:
            network = _network(hosts[each])
            counts = [_network(hosts[other]) for other in before]
            assert counts.count(network) == max(map(counts.count, counts)), (
                "of the network that most come from"
            )
            assert each == next(other for other in before if _network(hosts[other]) == network), "the oldest"


def _network(host: str | None) -> str:
    return "2001:db8::" if host in ("2001:db8::1", "2001:db8::2") else str(host)


def test_a_host_that_fills_all_places_keeps_out_nobody_of_another():
    pending, cut = PendingConnections(most=8), []
    for index in range(8):
        pending.add("192.0.2.1", lambda index=index: cut.append(index))
    pending.add("192.0.2.2", lambda: cut.append("ada"))
    for index in range(8, 100):
        pending.add("192.0.2.1", lambda index=index: cut.append(index))
    assert cut == list(range(93))


@pytest.mark.parametrize("address", ["2001:db8::1%eth0", "::ffff:192.0.2.1", "", None, "unix"])
def test_every_address_is_taken(address):
    PendingConnections().add(address, lambda: None)


def test_somebody_comes_in_past_many_who_say_nothing(monkeypatch):
    monkeypatch.setattr("room.server.room_sockets.PendingConnections", lambda: PendingConnections(most=8))

    async def run() -> None:
        async with open_room() as place:
            silent = [await place.connect() for _ in range(20)]
            ada = await place.guest()
            async with asyncio.timeout(SOON_S):
                assert (await silent[0].receive()).type in (
                    WSMsgType.CLOSE,
                    WSMsgType.CLOSED,
                    WSMsgType.ERROR,
                )
            assert not ada.socket.closed
            for socket in silent:
                await socket.close()

    asyncio.run(run())


def test_who_leaves_during_the_handshake_is_no_fault(caplog):
    async def run() -> None:
        async with open_room() as place:
            for _ in range(20):  # in one thread: the server answers when all of them have gone
                hang_up(f"{place.address}/room/{place.name}/socket")
            await place.guest()

    asyncio.run(run())
    assert caplog.records == []
