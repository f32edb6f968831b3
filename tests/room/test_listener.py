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

from room.server import Limits, Relays, Rooms, new_keys
from room.server.listener import Listener, bind
from tests.room.guests import SOON_S, Place

ROOT = Path(__file__).resolve().parents[2]

resource = pytest.importorskip("resource")


@asynccontextmanager
async def listening(*, most: int = 100) -> AsyncIterator[Place]:
    """A server behind a listener, as `room serve` has it."""
    keys = new_keys()
    rooms = Rooms(keys, limits=Limits(), relays=Relays())
    application = rooms.application()
    runner = web.AppRunner(application, access_log=None, shutdown_timeout=0.1)
    listener = Listener(lambda: runner.server(), tls=None, most=most)
    application.middlewares.append(listener.hear)
    await runner.setup()
    sockets = await bind("127.0.0.1", 0)
    place = Place(f"http://127.0.0.1:{sockets[0].getsockname()[1]}", keys)
    try:
        async with listener.listening(sockets, failed=rooms.stopped.set):
            yield place
    finally:
        await place.session.close()
        await runner.cleanup()


async def silent(place: Place, said: bytes = b"") -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    reader, writer = await asyncio.open_connection("127.0.0.1", int(place.address.rpartition(":")[2]))
    writer.write(said)
    return reader, writer


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


def test_where_all_have_asked_the_next_gets_in_when_one_has_gone():
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
