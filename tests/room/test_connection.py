"""A connection whose other end reads nothing: it is never waited for, and keeps a bounded number of things."""

import asyncio
from collections.abc import Callable

import pytest

from room.protocol.answers import Notice
from room.protocol.tick import pack
from room.server.connection import CLOSED_BY_RULE, Connection
from room.server.limits import MOST_QUEUED, MOST_TICKS_QUEUED
from room.server.metrics import Metrics


class Socket:
    """Takes what is sent once `reads` is set."""

    def __init__(self) -> None:
        self.reads = asyncio.Event()
        self.texts: list[str] = []
        self.ticks: list[bytes] = []
        self.code: int | None = None

    async def send_str(self, text: str) -> None:
        await self.reads.wait()
        self.texts.append(text)

    async def send_bytes(self, content: bytes) -> None:
        await self.reads.wait()
        self.ticks.append(content)

    async def close(self, *, code: int, message: bytes) -> None:
        self.code = code


async def until(true: Callable[[], bool]) -> None:
    """Let the connection send, until something is so."""
    async with asyncio.timeout(60):
        while not true():
            await asyncio.sleep(0.001)


TICKS = [pack([], time_ms=number) for number in range(200)]


def test_ticks_are_dropped_but_the_newest():
    async def run() -> None:
        socket, metrics = Socket(), Metrics()
        connection = Connection(socket, metrics)
        for content in TICKS:
            connection.tick(content)
            await asyncio.sleep(0)
        socket.reads.set()
        await until(lambda: len(socket.ticks) > MOST_TICKS_QUEUED)
        # the first one was on its way when the others came
        assert socket.ticks == [TICKS[0], *TICKS[-MOST_TICKS_QUEUED:]]
        assert metrics.ticks_dropped == len(TICKS) - 1 - MOST_TICKS_QUEUED
        await connection.close()

    asyncio.run(run())


def test_texts_are_never_dropped_and_too_many_end_the_connection():
    async def run() -> None:
        socket, metrics = Socket(), Metrics()
        connection = Connection(socket, metrics)
        for number in range(MOST_QUEUED):
            connection.say(Notice(text=str(number)))
        assert metrics.slow == 0
        connection.say(Notice(text="one more"))
        assert metrics.slow == 1
        socket.reads.set()
        await until(lambda: socket.code is not None)
        assert "too slow" in socket.texts[-1]
        assert socket.code == CLOSED_BY_RULE
        await connection.close()

    asyncio.run(run())


@pytest.mark.parametrize("count", [1, MOST_QUEUED])
def test_texts_come_in_their_order(count):
    async def run() -> None:
        socket = Socket()
        connection = Connection(socket, Metrics())
        for number in range(count):
            connection.say(Notice(text=str(number)))
        socket.reads.set()
        await until(lambda: len(socket.texts) >= count)
        assert socket.texts == [Notice(text=str(number)).model_dump_json() for number in range(count)]
        await connection.close()

    asyncio.run(run())
