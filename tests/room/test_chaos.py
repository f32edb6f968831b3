"""What goes wrong in meetings, done to a real server process: nobody else notices more than a pause."""

import asyncio
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import aiohttp
import psutil
import pytest

from room.protocol.answers import Changed, Left, Welcome
from room.server import load_keys
from tests.room.engines import free_port, needs_redis, redis
from tests.room.guests import SOON_S, Guest, Place

ROOT = Path(__file__).resolve().parents[2]
BACK_S = 15.0
"""After three seconds everybody is to be back where they stood; a slow machine with other work is given time."""
PAUSE_S = 10.0
"""The same of a pause of one second at most."""


@contextmanager
def server(folder: Path, port: int, *options: str) -> Iterator[subprocess.Popen]:
    """``room serve`` as people start it."""
    command = (
        sys.executable,
        "-m",
        "room",
        "serve",
        "--port",
        str(port),
        "--keys",
        str(folder / "room.keys"),
        *options,
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
    )
    try:
        assert "#" in process.stdout.readline(), process.stderr.read()
        yield process
    finally:
        process.kill()
        process.communicate()


def _place(folder: Path, port: int) -> Place:
    return Place(f"http://127.0.0.1:{port}", load_keys(folder / "room.keys"))


async def _back(place: Place, guest: Guest, **state: object) -> Guest:
    """What a page does when its connection ends: tries again, and says where it stands."""
    while True:
        with suppress(aiohttp.ClientError):
            again = await place.guest(secret=guest.secret, name=guest.welcome.people[-1].name)
            await again.move(**state)
            return again
        await asyncio.sleep(0.25)


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no process can be killed so here")
def test_a_killed_server_comes_back_with_its_people_where_they_stood(tmp_path):
    port = free_port()
    stood = [{"floor_m": (float(index), -1.0), "heading": 0.5} for index in range(4)]

    async def meet(process: subprocess.Popen) -> tuple[Place, list[Guest]]:
        place = _place(tmp_path, port)
        guests = [await place.guest(name=f"Guest {index}") for index in range(4)]
        for guest, state in zip(guests, stood, strict=True):
            await guest.move(**state)
        await guests[0].until(lambda: len(guests[0].states) == 4)
        process.send_signal(signal.SIGKILL)
        for guest in guests:
            await guest.end()
        return place, guests

    async def run() -> None:
        with server(tmp_path, port) as first:
            place, guests = await meet(first)
        with server(tmp_path, port):
            start = time.monotonic()
            pairs = zip(guests, stood, strict=True)
            again = await asyncio.gather(*(_back(place, guest, **state) for guest, state in pairs))
            await again[0].until(lambda: len(again[0].states) == 4)
            assert time.monotonic() - start < BACK_S
            for before, after, state in zip(guests, again, stood, strict=True):
                assert after.welcome.id == before.welcome.id
                assert again[0].states[after.number].floor_m == state["floor_m"]
        await place.session.close()

    asyncio.run(run())


@needs_redis
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no process can be killed so here")
def test_people_of_a_killed_server_go_on_by_another_one_where_they_stood(tmp_path):
    """Two processes carry one room over Redis; a page whose server ends comes back by whichever answers."""

    async def run() -> None:
        ports, wire = [free_port(), free_port()], free_port()
        options = ("--redis", f"redis://127.0.0.1:{wire}/0")
        with (
            redis(wire),
            server(tmp_path, ports[0], *options) as first,
            server(tmp_path, ports[1], *options),
        ):
            north, south = (_place(tmp_path, port) for port in ports)
            ada, ben = await north.guest(), await south.guest(name="Ben")
            await ada.move(floor_m=(3.0, 4.0))
            await ben.until(lambda: ada.number in ben.states)
            first.send_signal(signal.SIGKILL)
            await ada.end()
            start = time.monotonic()
            again = await south.guest(secret=ada.secret)
            assert (again.number, again.welcome.id) == (ada.number, ada.welcome.id)
            await again.until(lambda: again.number in again.states)
            assert again.states[again.number].floor_m == (3.0, 4.0)
            await again.move(floor_m=(5.0, 4.0))
            await ben.until(lambda: ben.states[ada.number].floor_m == (5.0, 4.0))
            print(f"back by another server after {time.monotonic() - start:.2f} s")
            assert time.monotonic() - start < BACK_S
            assert not ben.all(Left)
            for place in (north, south):
                await place.session.close()

    asyncio.run(run())


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_stopped_server_says_so_and_ends_well_and_in_time(tmp_path, number):
    async def run() -> None:
        port = free_port()
        with server(tmp_path, port) as process:
            place = _place(tmp_path, port)
            ada = await place.guest()
            process.send_signal(number)
            code, _ = await ada.end()
            assert code == 1012, "service restart: pages come back by themselves"
            assert await asyncio.to_thread(process.wait, 120) == 0
            said = process.stderr.read().splitlines()
            assert said == [
                "room: open; Ctrl-C stops it",
                "room: stopped; its links open again with the same --keys",
            ]
            await place.session.close()

    asyncio.run(run())


def test_a_message_of_a_gigabyte_takes_no_memory_and_nobody_notices(tmp_path):
    piece = bytes(1024 * 1024)

    async def send(port: int) -> int:
        """A frame whose header claims a gigabyte, sent as far as the server takes it; gives the MiB that went."""
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(
            b"GET /room/meeting/socket HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        )
        await reader.readuntil(b"\r\n\r\n")
        writer.write(b"\x82\xff" + (1024**3).to_bytes(8, "big") + bytes(4))
        sent = 0
        with suppress(ConnectionError):
            while sent < 1024:
                writer.write(piece)
                await writer.drain()
                sent += 1
        writer.close()
        with suppress(ConnectionError):
            await writer.wait_closed()
        return sent

    async def run() -> None:
        port = free_port()
        with server(tmp_path, port) as process:
            place = _place(tmp_path, port)
            ada, ben = await place.guest(), await place.guest(name="Ben")
            before = psutil.Process(process.pid).memory_info().rss
            async with asyncio.timeout(SOON_S):
                sent = await send(port)
            await ada.move(sequence=9)
            await ben.until(lambda: ada.number in ben.states)
            assert psutil.Process(process.pid).memory_info().rss - before < 20 * 1024**2
            assert sent < 512, "the connection is cut long before"
            await place.session.close()

    asyncio.run(run())


def test_many_who_talk_nonsense_disturb_nobody(tmp_path):
    async def nonsense(place: Place, index: int) -> None:
        socket = await place.connect()
        with suppress(ConnectionError, aiohttp.ClientError):
            for step in range(200):
                await socket.send_bytes(os.urandom(1 + (index * 37 + step) % 300))
        await socket.close()

    async def run() -> None:
        port = free_port()
        with server(tmp_path, port):
            place = _place(tmp_path, port)
            ada, ben = await place.guest(), await place.guest(name="Ben")
            floods = asyncio.gather(*(nonsense(place, index) for index in range(40)))
            worst = 0.0
            for step in range(60):
                start = time.monotonic()
                await ada.move(sequence=step)
                await ben.until(
                    lambda step=step: ada.number in ben.states and ben.states[ada.number].sequence == step
                )
                worst = max(worst, time.monotonic() - start)
            await floods
            print(f"longest wait in the flood {worst:.2f} s")
            assert worst < PAUSE_S, "a pause at most"
            assert not ada.socket.closed
            assert not ben.socket.closed
            await place.session.close()

    asyncio.run(run())


def test_a_guest_who_claims_another_is_told_by_the_secret_alone(tmp_path):
    async def run() -> None:
        port = free_port()
        with server(tmp_path, port):
            place = _place(tmp_path, port)
            ada, ben = await place.guest(), await place.guest(name="Ben")
            await ada.move(floor_m=(1.0, 1.0))
            # the public id of somebody is no secret of theirs, and a message has no room for a number
            thief = await place.guest(secret=ada.welcome.id.ljust(22, "0"), name="Ada")
            await thief.move(floor_m=(9.0, 9.0))
            await ben.until(lambda: thief.number in ben.states and ada.number in ben.states)
            assert thief.number != ada.number
            assert ben.states[ada.number].floor_m == (1.0, 1.0)
            assert len(ben.all(Changed)) == 1
            assert len(ben.all(Welcome)) == 1
            await place.session.close()

    asyncio.run(run())
