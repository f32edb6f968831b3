"""What floods and slow networks do to a real server: who reads stays, and nothing grows old on the way."""

import asyncio
import base64
import os
import socket

import pytest

from room.protocol.answers import Changed, Line, Signal
from room.server.connection import Connection
from room.server.limits import MOST_TICKS_QUEUED
from room.server.metrics import Metrics
from room.state import Meeting
from tests.room.guests import SOON_S, Place, meeting, open_room


def test_who_sends_a_burst_of_calls_throws_nobody_out(monkeypatch):
    """All have arrived before the first is heard: none of it could go on to whom it is for, if none waited for that."""
    monkeypatch.setattr("room.server.connection.MOST_FROM_ONE_BYTES", 16 * 1024)

    async def run() -> None:
        async with open_room() as place:
            teacher, eve = await place.guest(moderator=True), await place.guest(name="Eve")
            texts = [str(number) for number in range(1500)]
            for text in texts:
                await eve.say(kind="candidate", to=teacher.number, candidate=text)
            await eve.say(kind="chat", text="all is said")
            await teacher.told(Line)
            assert [signal.signal.candidate for signal in teacher.all(Signal)] == texts
            await teacher.say(kind="chat", text="here still")
            await eve.told(Line, lambda line: line.number == teacher.number)

    asyncio.run(run())


@meeting
async def test_guests_who_turn_their_voices_on_and_off_throw_nobody_out(place):
    people = [await place.guest(name=str(number)) for number in range(10)]
    for guest in people[:4]:
        for step in range(190):
            await guest.say(kind="voice", open=step % 2 == 0)
        await guest.say(kind="chat", text="done")
    for guest in people:
        await guest.until(lambda guest=guest: len(guest.all(Line)) == 4)
        last = {changed.person.number: changed.person.voice for changed in guest.all(Changed)}
        assert not any(last.get(other.number) for other in people[:4]), "the newest word is the last one"


@meeting
async def test_what_changes_nothing_is_told_to_nobody(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    for _ in range(50):
        await ada.say(kind="voice", open=True)
        await ada.say(kind="undress")
    await ada.say(kind="chat", text="done")
    await ben.told(Line)
    told = [each.person for each in ben.all(Changed) if each.person.number == ada.number]
    assert [person.voice for person in told] == [True]


def _upgrade(place: Place) -> bytes:
    lines = (
        f"GET /room/{place.name}/socket HTTP/1.1",
        "Host: " + place.address.removeprefix("http://"),
        "Upgrade: websocket",
        "Connection: Upgrade",
        "Sec-WebSocket-Version: 13",
        "Sec-WebSocket-Key: " + base64.b64encode(bytes(16)).decode(),
        "",
        "",
    )
    return "\r\n".join(lines).encode()


def _masked(text: bytes) -> bytes:
    """A text as a browser sends it, with a mask of zeros."""
    return b"\x81" + bytes((0x80 | 126,)) + len(text).to_bytes(2, "big") + bytes(4) + text


@pytest.mark.skipif(not hasattr(socket, "TCP_NOTSENT_LOWAT"), reason="this system takes what it is given")
def test_who_reads_nothing_for_a_while_then_gets_the_newest(monkeypatch):
    """A tick that was handed to the system can no longer be replaced: hardly any may be, however slow the link."""
    ticks: list[bytes] = []

    def tick(self: Meeting, *, now: float) -> bytes | None:
        if len(ticks) == 200:
            return None
        ticks.append(b"TICK" + len(ticks).to_bytes(4, "big") + os.urandom(60_000))
        return ticks[-1]

    monkeypatch.setattr(Meeting, "tick", tick)
    monkeypatch.setattr("room.server.live_rooms.HERTZ", 200)

    async def run() -> None:
        loop = asyncio.get_running_loop()
        async with open_room() as place:
            with socket.socket() as link:
                link.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 16 * 1024)
                link.setblocking(False)
                await loop.sock_connect(link, ("127.0.0.1", int(place.address.rpartition(":")[2])))
                await loop.sock_sendall(
                    link, _upgrade(place) + _masked(place.join().model_dump_json().encode())
                )
                while len(ticks) < 200:
                    await asyncio.sleep(0.01)
                read = b""
                async with asyncio.timeout(SOON_S):
                    while ticks[-1][:40] not in read[-100_000:]:
                        read += await loop.sock_recv(link, 2**20)
        came = [number for number, content in enumerate(ticks) if content[:40] in read]
        old = [number for number in came if number < len(ticks) - MOST_TICKS_QUEUED]
        assert len(old) <= 6, "0.4 MB of them, where the system alone would take ten times as much"

    asyncio.run(run())


def test_ticks_wait_where_newer_ones_replace_them_while_the_network_takes_none():
    unsent = 0

    class Socket:
        sent = 0

        async def send_bytes(self, content: bytes) -> None:
            nonlocal unsent
            self.sent, unsent = self.sent + 1, unsent + len(content)

    async def run() -> None:
        nonlocal unsent
        wire = Socket()
        connection = Connection(wire, Metrics(), unsent=lambda: unsent)
        for _ in range(50):
            connection.tick(bytes(10_000))
            await asyncio.sleep(0)
        assert wire.sent == 2
        unsent = 0
        while wire.sent < 4:
            await asyncio.sleep(0.01)
        await connection.close()

    asyncio.run(run())
