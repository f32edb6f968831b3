"""Brings the people of a recording into a room, where they move as they moved: from anywhere, slowly, or halted."""

import bisect
from collections.abc import Iterator
from dataclasses import dataclass

from room.errors import InputError, NotAllowed
from room.protocol.answers import Changed, Left, Playing
from room.protocol.message import retimed, time_of
from room.protocol.texts import Play
from room.recording import Survey, follow_recording
from room.recording.lines import Came, Event, Gone, Tick
from room.server.limits import PLAYS_PER_S, Bucket
from room.state import Meeting, Seat

AGAIN_S = 3.0
"""From the last state to the beginning of the next round: faces come to rest in 1.3."""

HOLD_S = 0.2
"""While it is halted, states are said again after this time: pages let a face sink that is silent for 0.7."""

LEAD_MARKS = 1
"""A jump reads from so many marks before it: whoever is there has said something in that second."""

Told = Changed | Left | Playing


@dataclass(kw_only=True)
class _Actor:
    """Somebody of the recording, and how their clock goes in this replay.

    ``sent_ms`` is the time in their newest state as it was sent, ``own_ms`` the one that was recorded, and ``at`` when.
    """

    seat: Seat
    came: Came
    state: bytes | None = None
    own_ms: int = 0
    sent_ms: float = 0.0
    at: float = 0.0
    jumps: bool = True

    def move(self, state: bytes, meeting: Meeting, *, now: float, speed: float) -> None:
        """Go on to a recorded state."""
        own_ms = time_of(state)
        if self.state is None:
            self.sent_ms = own_ms
        elif (
            self.jumps
        ):  # halted, moved along, or played at another speed: the clock that is sent goes on evenly
            self.sent_ms += (now - self.at) * 1000
        else:
            self.sent_ms += ((own_ms - self.own_ms + 2**31) % 2**32 - 2**31) / speed
        self.jumps, self.state, self.own_ms = False, state, own_ms
        self._say(meeting, now)

    def hold(self, meeting: Meeting, *, now: float) -> None:
        """Stay as one is."""
        if self.state is not None and now - self.at >= HOLD_S:
            self.sent_ms += (now - self.at) * 1000
            self.jumps = True
            self._say(meeting, now)

    def _say(self, meeting: Meeting, now: float) -> None:
        self.at = now
        if meeting.seat(self.seat.id) is self.seat:  # a moderator may have removed them
            meeting.take(self.seat, retimed(self.state, int(self.sent_ms)), program=False, now=now)


class Replay:
    """One round of a recording after the other, from when somebody first looks.

    Parameters
    ----------
    survey
        Of a recording that was checked. If it becomes unreadable, that is its end.
    """

    def __init__(self, survey: Survey) -> None:
        self._survey = survey
        self._plays = Bucket(PLAYS_PER_S, burst=2 * PLAYS_PER_S)
        self._lines: Iterator[Event] = iter(())
        self._next: Event | None = None
        self._cast: dict[int, _Actor] = {}
        self._begun = self._paused = False
        self._speed = 1.0
        self._position_ms, self._at = float(survey.begins_ms), 0.0

    def step(self, meeting: Meeting, *, now: float) -> list[Told]:
        """Do what is due; gives what those who look are to be told. ``now`` in seconds."""
        told: list[Told] = []
        if not self._begun:
            self._open(now, self._survey.begins_ms, first=0)
            told.append(self.playing(now=now))
        if self._paused:
            for actor in self._cast.values():
                actor.hold(meeting, now=now)
            return told
        position = self._position(now)
        newest: dict[int, bytes] = {}
        while self._next is not None and self._next.time_ms <= position:
            told += self._act(meeting, self._next, newest, now)
            self._next = next(self._lines, None)
        self._move(meeting, newest, now)
        if self._next is None and position > self._survey.ends_ms + AGAIN_S * 1000 * self._speed:
            for number in list(self._cast):
                told += self._go(meeting, number)
            self.close()
            self._begun = False
        return told

    def play(self, said: Play, meeting: Meeting, *, now: float) -> list[Told]:
        """Halt, go on, jump or change the pace, as somebody who looks asks.

        Raises
        ------
        NotAllowed
            If those who look ask too often: each jump reads the file.
        """
        if not self._plays.take(now=now):
            raise NotAllowed("that was too fast; the replay goes on as it was", again=True)
        ends = self._survey.ends_ms
        self._position_ms, self._at = min(self._position(now), ends), now
        told: list[Told] = []
        if said.time_s is not None:
            told += self._jump(min(self._survey.begins_ms + said.time_s * 1000, ends), meeting, now)
        self._speed = said.speed or self._speed
        self._paused = self._paused if said.paused is None else said.paused
        for actor in self._cast.values():
            actor.jumps = True
        return [*told, self.playing(now=now)]

    def playing(self, *, now: float) -> Playing:
        """Where the replay is, for who looks."""
        begins, ends = self._survey.begins_ms, self._survey.ends_ms
        return Playing(
            time_s=max(0.0, min(self._position(now), ends) - begins) / 1000,
            length_s=(ends - begins) / 1000,
            paused=self._paused,
            speed=self._speed,
        )

    def close(self) -> None:
        """Let go of the file."""
        if hasattr(self._lines, "close"):
            self._lines.close()

    def _position(self, now: float) -> float:
        """Milliseconds of the recording."""
        runs = self._begun and not self._paused
        return self._position_ms + ((now - self._at) * 1000 * self._speed if runs else 0.0)

    def _open(self, now: float, position_ms: float, *, first: int) -> None:
        """Read from a mark on. What happened before the first person came is not waited for."""
        self.close()
        self._lines = _unbroken(follow_recording(self._survey.path, self._survey.marks[first]))
        self._next = next(self._lines, None)
        self._position_ms, self._at, self._begun = position_ms, now, True

    def _jump(self, position_ms: float, meeting: Meeting, now: float) -> list[Told]:
        marks = self._survey.marks
        first = max(
            0, bisect.bisect_right(marks, position_ms, key=lambda mark: mark.time_ms) - 1 - LEAD_MARKS
        )
        self._open(now, position_ms, first=first)
        there, newest = dict(self._survey.marks[first].cast), {}
        while self._next is not None and self._next.time_ms <= position_ms:
            match self._next:
                case Came():
                    there[self._next.number] = self._next
                case Gone():
                    there.pop(self._next.number, None)
                    newest.pop(self._next.number, None)
                case Tick():
                    newest |= dict(self._next.states)
            self._next = next(self._lines, None)
        told: list[Told] = []
        for number, actor in list(self._cast.items()):
            # who has said nothing yet stood nowhere, and comes in anew
            if number not in newest or _who(there[number]) != _who(actor.came):
                told += self._go(meeting, number)
        for number, came in there.items():
            if number not in self._cast:
                told += self._come(meeting, came)
        for actor in self._cast.values():
            actor.jumps = True
        self._move(meeting, newest, now)
        return told

    def _act(self, meeting: Meeting, event: Event, newest: dict[int, bytes], now: float) -> list[Told]:
        match event:
            case Came():
                self._move(meeting, newest, now)
                return [*self._go(meeting, event.number), *self._come(meeting, event)]
            case Gone():
                self._move(meeting, newest, now)
                return self._go(meeting, event.number)
            case Tick() if (
                self._speed > 1
            ):  # of several states of one person the newest counts, or rates would rise
                newest |= dict(event.states)
            case Tick():
                for number, state in event.states:
                    self._cast[number].move(state, meeting, now=now, speed=self._speed)
        return []

    def _move(self, meeting: Meeting, newest: dict[int, bytes], now: float) -> None:
        for number, state in newest.items():
            self._cast[number].move(state, meeting, now=now, speed=self._speed)
        newest.clear()

    def _come(self, meeting: Meeting, came: Came) -> list[Told]:
        seat = meeting.replay(
            id=f"{came.id}-{came.number}", name=came.name, avatar=came.avatar, number=came.number
        )
        self._cast[came.number] = _Actor(seat=seat, came=came)
        return [Changed(person=seat.person)]

    def _go(self, meeting: Meeting, number: int) -> list[Told]:
        actor = self._cast.pop(number, None)
        if actor is None or meeting.seat(actor.seat.id) is not actor.seat:
            return []  # a moderator has removed them, and a visitor may have their number by now
        meeting.leave(actor.seat)
        return [Left(number=actor.seat.number)]


def _who(came: Came) -> tuple[str, str, str]:
    return came.id, came.name, came.avatar


def _unbroken(lines: Iterator[Event]) -> Iterator[Event]:
    try:
        yield from lines
    except InputError:
        return
