"""A connection whose other end reads nothing: it is never waited for, and keeps a bounded number of things."""

import asyncio
from collections.abc import Callable
from itertools import zip_longest

import pytest
from hypothesis import given
from hypothesis import strategies as st

from room.protocol.answers import Changed, Left, Notice, Person, Signal
from room.protocol.texts import Candidate
from room.protocol.tick import pack
from room.server.connection import CLOSED_BY_RULE, Connection
from room.server.limits import MOST_FROM_ONE_BYTES, MOST_QUEUED_BYTES, MOST_TICKS_QUEUED
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
        line = Notice(text="x" * 64 * 1024)
        for _ in range(MOST_QUEUED_BYTES // len(line.model_dump_json())):
            connection.say(line)
        assert metrics.slow == 0
        connection.say(line)
        connection.say(line)
        assert metrics.slow == 1
        socket.reads.set()
        await until(lambda: socket.code is not None)
        assert "too slow" in socket.texts[-1]
        assert socket.code == CLOSED_BY_RULE
        await connection.close()

    asyncio.run(run())


def test_who_takes_nothing_for_long_is_too_slow_however_little_waits(monkeypatch):
    monkeypatch.setattr("room.server.connection.PATIENCE_S", 0.05)

    async def run() -> None:
        socket, metrics = Socket(), Metrics()
        connection = Connection(socket, metrics)
        while not metrics.slow:
            connection.say(Notice(text="a word"))
            await asyncio.sleep(0.01)
        socket.reads.set()
        await until(lambda: socket.code is not None)
        await connection.close()

    asyncio.run(run())


PERSON = Person(
    number=3, id="", name="", avatar="plain", visit="", moderator=False, present=True, voice=False,
    muted=False, face="page", recorded=False, replayed=False,
)  # fmt: skip


def _signal(sender: int, text: str = "") -> Signal:
    return Signal(sender=sender, signal=Candidate(to=0, candidate=text))


TOLD = {
    "how they are": lambda draw: Changed(
        person=PERSON.model_copy(update={"number": draw % 3, "visit": str(draw)})
    ),
    "that they left": lambda draw: Left(number=draw % 3),
    "what they call": lambda draw: _signal(draw % 3, str(draw)),
}


@given(st.lists(st.tuples(st.sampled_from(sorted(TOLD)), st.integers(0, 99)), max_size=40))
def test_of_waiting_words_of_a_person_the_newest_goes_where_nothing_came_between(said):
    """What a page knows in the end, and at each call of a person, is never older than if all had been sent."""
    answers = [TOLD[kind](draw) for kind, draw in said]

    async def run() -> list[str]:
        socket = Socket()
        connection = Connection(socket, Metrics())
        for answer in answers:
            (connection.pass_on if isinstance(answer, Signal) else connection.say)(answer)
        connection.say(Notice(text="the end"))
        socket.reads.set()
        await until(lambda: socket.texts and "the end" in socket.texts[-1])
        await connection.close()
        return socket.texts[:-1]

    sent = asyncio.run(run())
    kept: list[str] = []
    for number in range(3):
        of = [each for each in answers if _of(each) == number]
        # of several accounts in a row the last one counts
        want = [
            a for a, b in zip_longest(of, of[1:]) if not isinstance(a, Changed) or not isinstance(b, Changed)
        ]
        got = [
            text
            for text in sent
            if f'"number":{number},' in text
            or f'"number":{number}}}' in text
            or f'"sender":{number},' in text
        ]
        assert got == [each.model_dump_json(exclude_none=True) for each in want]
        kept += got
    assert sorted(kept) == sorted(sent)


def _of(answer: Changed | Left | Signal) -> object:
    match answer:
        case Changed():
            return answer.person.number
        case Left():
            return answer.number
    return answer.sender


def test_what_one_person_calls_is_dropped_where_too_much_of_it_waits_and_the_others_are_heard():
    async def run() -> None:
        socket, metrics = Socket(), Metrics()
        connection = Connection(socket, metrics)
        for _ in range(MOST_QUEUED_BYTES // 1024):
            connection.pass_on(_signal(1, "x" * 1024))
        connection.pass_on(_signal(2, "of another"))
        assert metrics.slow == 0
        socket.reads.set()
        await until(lambda: "of another" in (socket.texts or [""])[-1])
        assert sum(map(len, socket.texts[:-1])) <= MOST_FROM_ONE_BYTES
        connection.pass_on(_signal(1, "again"))
        await until(lambda: "again" in socket.texts[-1])
        await connection.close()

    asyncio.run(run())


@pytest.mark.parametrize("count", [1, 512])
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
