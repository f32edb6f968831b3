"""Connections that ask nothing: they end by themselves, and however many there are, others are answered."""

import asyncio
import os
import socket
import subprocess
import sys
import urllib.request
from collections.abc import AsyncIterator
from contextlib import ExitStack, asynccontextmanager, suppress
from pathlib import Path

import pytest
from aiohttp import web

from room.places import Place as Scenery
from room.server import Limits, Relays, Rooms, new_keys
from room.server.bodies import PIECE_BYTES
from room.server.listener import Listener, bind
from tests.room.guests import SOON_S, Place

ROOT = Path(__file__).resolve().parents[2]

resource = pytest.importorskip("resource")


@asynccontextmanager
async def listening(*, most: int = 100) -> AsyncIterator[Place]:
    """A server behind a listener, as `room serve` has it."""
    keys = new_keys()
    rooms = Rooms(keys, limits=Limits(), relays=Relays(), places={"": Scenery(content=LARGE)})
    application = rooms.application()
    runner = web.AppRunner(application, access_log=None, shutdown_timeout=0.1)
    listener = Listener(lambda: runner.server(), tls=None, most=most)
    application.middlewares.append(listener.hear)
    application.on_response_prepare.append(listener.prepare)
    await runner.setup()
    sockets = await bind("127.0.0.1", 0)
    place = Place(f"http://127.0.0.1:{sockets[0].getsockname()[1]}", keys)
    place.transports = lambda: [each.transport for each in runner.server.connections if each.transport]
    try:
        async with listener.listening(sockets, failed=rooms.stopped.set):
            yield place
    finally:
        await place.session.close()
        going = place.transports()
        await runner.cleanup()
        for transport in going:  # what waits for who reads nothing is cut, not flushed
            transport.abort()
        await asyncio.sleep(0)


async def silent(place: Place, said: bytes = b"") -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    reader, writer = await asyncio.open_connection("127.0.0.1", int(place.address.rpartition(":")[2]))
    writer.write(said)
    return reader, writer


LARGE = bytes(12 * 2**20)
"""More than what two systems take on the way: a place whose end waits at the server for who reads nothing."""

ASKED = b"GET /room/meeting/place.glb HTTP/1.1\r\nHost: a\r\n\r\n"


async def asking(place: Place, stack: ExitStack) -> socket.socket:
    """A connection that has asked for much and reads nothing, until its answer has begun."""
    wire = stack.enter_context(socket.socket())
    wire.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    wire.setblocking(False)
    loop = asyncio.get_running_loop()
    await loop.sock_connect(wire, ("127.0.0.1", int(place.address.rpartition(":")[2])))
    await loop.sock_sendall(wire, ASKED)
    async with asyncio.timeout(SOON_S):
        while True:
            with suppress(BlockingIOError):
                assert wire.recv(1, socket.MSG_PEEK), "it was cut"
                return wire
            await asyncio.sleep(0.01)


async def read_on(wire: socket.socket) -> int:
    """What comes until the server ends the connection."""
    size, loop = 0, asyncio.get_running_loop()
    async with asyncio.timeout(SOON_S):
        with suppress(ConnectionError):
            while piece := await loop.sock_recv(wire, 2**20):
                size += len(piece)
    return size


async def ended(reader: asyncio.StreamReader) -> None:
    async with asyncio.timeout(SOON_S):
        with suppress(ConnectionError):
            assert await reader.read() == b""


@pytest.mark.parametrize("said", [b"", b"GET / HT", b"GET /health HTTP/1.1\r\nHost: a\r\n"])
def test_who_asks_nothing_whole_is_cut_and_who_came_in_stays(said, monkeypatch):
    monkeypatch.setattr("room.server.listener.REQUEST_S", 0.3)

    async def run() -> None:
        async with listening() as place:
            ada = await place.guest()
            reader, writer = await silent(place, said)
            await ended(reader)
            writer.close()
            await ada.move(sequence=7)
            await ada.until(lambda: (ada.number, 7) in ada.sequences)

    asyncio.run(run())


def test_with_too_many_the_oldest_that_asked_nothing_gives_way():
    async def run() -> None:
        async with listening(most=8) as place:
            ada = await place.guest()
            several = [await silent(place) for _ in range(30)]
            ben = await place.guest(name="Ben")
            await ended(several[0][0])
            await ada.move(sequence=7)
            await ben.until(lambda: (ada.number, 7) in ben.sequences)
            for _, writer in several:
                writer.close()

    asyncio.run(run())


def test_where_all_are_in_rooms_the_next_gets_in_when_one_has_gone():
    async def run() -> None:
        async with listening(most=3) as place:
            people = [await place.guest(name=str(number)) for number in range(3)]
            reader, writer = await silent(place)
            await ended(reader)
            writer.close()
            await people[0].go()
            async with asyncio.timeout(SOON_S):
                while True:
                    with suppress(OSError):
                        await place.guest(name="late")
                        return
                    await asyncio.sleep(0.05)

    asyncio.run(run())


def test_who_asks_for_much_and_reads_nothing_takes_no_memory_and_no_place():
    async def run() -> None:
        async with listening(most=8) as place:
            ada = await place.guest()
            wires = [await asking(place, stack) for _ in range(7)]
            await asyncio.sleep(0.2)
            waiting = [transport.get_write_buffer_size() for transport in place.transports()]
            assert len(waiting) == 8
            assert max(waiting) <= 4 * PIECE_BYTES < len(LARGE) / 2
            ben = await place.guest(name="Ben")
            async with place.session.get(f"{place.address}/health") as answer:
                assert await answer.text() == "well\n"
            await ada.move(sequence=7)
            await ben.until(lambda: (ada.number, 7) in ben.sequences)
            assert await read_on(wires[0]) < len(LARGE), "the oldest gave way"

    with ExitStack() as stack:
        asyncio.run(run())


def test_who_takes_an_answer_too_slowly_is_cut(monkeypatch):
    monkeypatch.setattr("room.server.bodies.PATIENCE_S", 0.3)
    monkeypatch.setattr("room.server.bodies.SLOWEST_BYTES_PER_S", 1e12)

    async def run() -> None:
        async with listening() as place:
            wire = await asking(place, stack)
            await asyncio.sleep(0.5)
            assert await read_on(wire) < len(LARGE)

    with ExitStack() as stack:
        asyncio.run(run())


def test_who_takes_little_beside_much_of_the_same_network_is_not_cut(monkeypatch):
    """Files of one person share a slow link, and each alone takes too little of it."""
    monkeypatch.setattr("room.server.bodies.PATIENCE_S", 0.5)
    monkeypatch.setattr("room.server.bodies.SLOWEST_BYTES_PER_S", len(LARGE) / 2)

    async def run() -> None:
        async with listening() as place:
            await asking(place, stack)
            end, whole = asyncio.get_running_loop().time() + 3, {"Accept-Encoding": "identity"}
            while asyncio.get_running_loop().time() < end:
                async with place.session.get(
                    f"{place.address}/room/meeting/place.glb", headers=whole
                ) as answer:
                    assert await answer.read() == LARGE
            assert sum(transport.get_write_buffer_size() > 0 for transport in place.transports()) == 1

    with ExitStack() as stack:
        asyncio.run(run())


def test_of_too_many_answers_the_oldest_gives_way(monkeypatch):
    monkeypatch.setattr("room.server.bodies.MOST_BODIES", 2)

    async def run() -> None:
        async with listening() as place:
            wires = [await asking(place, stack) for _ in range(3)]
            assert await read_on(wires[0]) < len(LARGE)
            assert len(place.transports()) == 2
            stack.close()
            async with place.session.get(f"{place.address}/room/meeting/place.glb") as answer:
                assert await answer.read() == LARGE

    with ExitStack() as stack:
        asyncio.run(run())


def test_a_large_answer_is_asked_for_by_its_head_alone():
    async def run() -> None:
        async with listening() as place:
            address = f"{place.address}/room/meeting/place.glb"
            for _ in range(2):
                async with place.session.head(address, headers={"Accept-Encoding": "identity"}) as answer:
                    assert int(answer.headers["Content-Length"]) == len(LARGE)
                    assert await answer.read() == b""

    asyncio.run(run())


def test_a_process_with_few_files_answers_past_many_silent_connections_and_writes_no_log(tmp_path):
    log = tmp_path / "log"
    command = (sys.executable, "-m", "room", "serve", "--port", "0")
    limit = f"ulimit -n 256 && exec {' '.join(command)}"
    with log.open("w") as errors, ExitStack() as stack:
        run = stack.enter_context(
            subprocess.Popen(
                ("sh", "-c", limit),
                stdout=subprocess.PIPE,
                stderr=errors,
                text=True,
                env={**os.environ, "PYTHONPATH": str(ROOT)},
            )
        )
        stack.callback(run.kill)
        page = run.stdout.readline().split("\t")[2].partition("#")[0]
        address = page.partition("/room/")[0]
        port = int(address.rpartition(":")[2])
        for _ in range(300):
            stack.enter_context(socket.create_connection(("127.0.0.1", port)))
        for scanned in (b"\x16\x03\x01\x02\0\r\n\r\n", b"GET / HTTP/9\r\n\r\n", b"SSH-2.0\r\n\r\n"):
            with socket.create_connection(("127.0.0.1", port)) as scanner:
                scanner.sendall(scanned)
                scanner.recv(1000)
        with urllib.request.urlopen(f"{address}/health", timeout=SOON_S) as answer:
            assert answer.read() == b"well\n"
    assert log.stat().st_size < 2000
    assert "Traceback" not in log.read_text()
