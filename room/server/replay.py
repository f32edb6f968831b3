"""Brings the people of a recording into a room, where they move as they moved."""

from collections.abc import Iterator
from pathlib import Path

from room.errors import InputError
from room.protocol.texts import Changed, Left
from room.recording import read_recording
from room.recording.lines import Came, Event, Gone, Heading, Tick
from room.state import Meeting, Seat

AGAIN_S = 3.0
"""From the last state to the beginning of the next round: faces come to rest in 1.3."""


class Replay:
    """One round of a recording after the other, from when somebody first looks.

    Parameters
    ----------
    path
        A recording that was checked. If it becomes unreadable, that is its end.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lines: Iterator[Heading | Event] = iter(())
        self._next: Event | None = None
        self._cast: dict[int, Seat] = {}
        self._began: float | None = None
        self._last_ms = 0

    def step(self, meeting: Meeting, *, now: float) -> list[Changed | Left]:
        """Do what is due; gives what those who look are to be told. ``now`` in seconds."""
        if self._began is None:
            self._begin(now)
        time_ms = (now - self._began) * 1000
        told: list[Changed | Left] = []
        while self._next is not None and self._next.time_ms <= time_ms:
            told += self._act(meeting, self._next, now)
            self._last_ms = self._next.time_ms
            self._next = self._following()
        if self._next is None and time_ms > self._last_ms + AGAIN_S * 1000:
            for number in list(self._cast):
                told += self._go(meeting, number)
            self.close()
            self._began = None
        return told

    def close(self) -> None:
        """Let go of the file."""
        if hasattr(self._lines, "close"):
            self._lines.close()

    def _begin(self, now: float) -> None:
        self._lines = read_recording(self._path)
        self._following()  # the heading
        self._next = self._following()
        # what happened before the first person came is not waited for
        self._began = now - (self._next.time_ms / 1000 if self._next else 0)

    def _following(self) -> Event | None:
        try:
            return next(self._lines, None)
        except InputError:
            return None

    def _act(self, meeting: Meeting, event: Event, now: float) -> list[Changed | Left]:
        match event:
            case Came():
                told = self._go(meeting, event.number)
                seat = meeting.replay(id=f"{event.id}-{event.number}", name=event.name, avatar=event.avatar)
                self._cast[event.number] = seat
                return [*told, Changed(person=seat.person)]
            case Gone():
                return self._go(meeting, event.number)
            case Tick():
                for number, state in event.states:
                    seat = self._cast[number]
                    if meeting.seat(seat.id) is seat:  # a moderator may have removed them
                        meeting.take(seat, state, program=False, now=now)
        return []

    def _go(self, meeting: Meeting, number: int) -> list[Changed | Left]:
        seat = self._cast.pop(number, None)
        if seat is None or meeting.seat(seat.id) is not seat:
            return []  # a moderator has removed them, and a visitor may have their number by now
        meeting.leave(seat)
        return [Left(number=seat.number)]
