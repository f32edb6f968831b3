"""Recordings for tests: what makes one, what is in it, and a short one of two people."""

import asyncio
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from facegen.conventions import BLENDSHAPES
from room.protocol import Message, decode, encode
from room.recording import Recorder, read_recording
from room.recording.lines import Came, Heading, Tick
from room.server.live_room import HERTZ
from tests.room.guests import Guest, open_room


def make_recorder(path: Path, *, ended: Callable[[str], None] = pytest.fail, **options: int) -> Recorder:
    return Recorder(path, room="meeting", hertz=HERTZ, ended=ended, **options)


def states(path: Path) -> list[tuple[int, Message]]:
    ticks = (line for line in read_recording(path) if isinstance(line, Tick))
    return [(number, decode(state)) for tick in ticks for number, state in tick.states]


async def walk(guest: Guest, *, steps: int = 20, **state: object) -> None:
    for step in range(steps):
        await guest.move(sequence=step, time_ms=step * 33, **state)
        await asyncio.sleep(1 / HERTZ)


def write_recording(path: Path, states: Iterable[Message]) -> Path:
    """A recording of one person, whose states came when they say, in the time of no clock."""
    lines = [
        Heading(room="meeting", began_s=1.0, hertz=HERTZ, shapes=BLENDSHAPES),
        Came(time_ms=0, number=0, id="0" * 16, name="Ada", avatar="plain"),
        *(Tick.model_construct(time_ms=state.time_ms, states=((0, encode(state)),)) for state in states),
    ]
    path.write_text("".join(f"{line.model_dump_json()}\n" for line in lines))
    return path


def recorded(path: Path) -> Path:
    """A short recording of two people, one of whom leaves."""

    async def run() -> None:
        async with open_room(recorder=make_recorder(path)) as place:
            ada, ben = [await place.guest(name=name, recorded=True) for name in ("Ada", "Ben")]
            await asyncio.gather(walk(ada, steps=15, heading=0.5), walk(ben, steps=10, flags=1))
            await ben.say(kind="leave")
            await walk(ada, steps=5, animation=3)
            await ada.until(lambda: len(ada.sequences) == 30)

    asyncio.run(run())
    return path
