"""Joins a room's state with the connections of those who are in it: who hears of what."""

import time
from typing import TYPE_CHECKING

from facegen.conventions import BLENDSHAPES
from room.avatars import Wardrobe
from room.errors import NotAllowed
from room.protocol.accounts import Part
from room.protocol.texts import (
    Answer,
    Candidate,
    Changed,
    Chat,
    Consent,
    Description,
    Door,
    Join,
    Leave,
    Left,
    Line,
    Moderate,
    Notice,
    Play,
    Said,
    Share,
    Signal,
    Undress,
    Voice,
    Welcome,
)
from room.recording import Recorder
from room.server.carrier import Carrier
from room.server.cloakroom import Cloakroom
from room.server.connection import Connection
from room.server.limits import PLAYS_PER_S, Bucket
from room.server.neighbours import Neighbours
from room.server.replay import Replay
from room.server.switchboard import Switchboard
from room.server.turn import Relays
from room.server.turnstile import Turnstile
from room.state import Meeting, Seat
from room.state.accounts import Ousted

if TYPE_CHECKING:  # needs an extra of its own
    from room.server.telegraph import Telegraph

HERTZ = 30
"""Ticks a second: as many as a camera has frames."""


class Hall:
    """One room with its connections.

    Parameters
    ----------
    name
        Of the room.
    most_people
        Places.
    relays
        What browsers are told for their voices.
    wardrobe
        Keeps the avatars that people bring.
    recorder
        Takes the states of those who agreed; None where nobody is recorded.
    replay
        Brings people of a recording in; None for a room of the living alone.
    telegraph
        Reaches the other processes that carry this room; None where there is one alone.
    carrier
        Brings own avatars from those processes, and to them; None where there is one alone.
    switchboard
        Has an engine pass voices on; None where they go from page to page.

    Attributes
    ----------
    cloakroom
        Has their own avatars.
    """

    def __init__(
        self,
        name: str,
        *,
        most_people: int,
        relays: Relays,
        wardrobe: Wardrobe,
        recorder: Recorder | None = None,
        replay: Replay | None = None,
        telegraph: "Telegraph | None" = None,
        carrier: Carrier | None = None,
        switchboard: Switchboard | None = None,
    ) -> None:
        self.name = name
        self._recorder, self._replay = recorder, replay
        process = telegraph.process if telegraph else ""
        self.meeting = Meeting(
            most_people=most_people, process=process, first_number=int(process[:4] or "0", 16)
        )
        self.cloakroom = Cloakroom(name, self.meeting, wardrobe, carrier)
        self._neighbours = telegraph and Neighbours(
            self.meeting,
            telegraph,
            name,
            tell=self._tell_here,
            call=self._call,
            oust=self._oust,
            undress=self._undressed,
            send=self.cloakroom.send,
        )
        self._relays = relays
        self._pages: dict[str, Connection] = {}
        self._programs: dict[str, Connection] = {}
        self._switchboard = switchboard
        self._turnstile = Turnstile(most_people)
        self._plays = Bucket(PLAYS_PER_S, burst=2 * PLAYS_PER_S)

    @property
    def empty(self) -> bool:
        """Whether nobody of this process has a place or a connection."""
        return self.meeting.empty and not self._pages and not self._programs

    async def open(self) -> None:
        """Learn who is in the room by other processes.

        Raises
        ------
        NotAllowed
            If they cannot be reached.
        """
        if self._neighbours:
            await self._neighbours.open()

    def enter(self, join: Join, connection: Connection, *, moderator: bool) -> Seat:
        """Bring somebody in, and tell the others; an older connection of the same person is closed.

        Raises
        ------
        NotAllowed
            As `room.state.Meeting.enter`, or if people come in so often that others hear of nothing else.
        """
        self._turnstile.count(join, self.meeting, moderator=moderator)
        seat = self.meeting.enter(join, moderator=moderator)
        connections = self._connections(join.role)
        if older := connections.pop(seat.id, None):
            older.refuse("you came in from another window", again=False)
        connections[seat.id] = connection
        page = join.role == "page"
        if page and not self.cloakroom.has(seat):
            seat.own = ""  # it stayed with the process that they came by before; their page brings it again
        if page:  # a program that moves a face has no say in this
            seat.recorded = join.recorded and self._recorder is not None
            self._record_roster()
        connection.say(
            Welcome(
                room=self.name,
                number=seat.number,
                id=seat.id,
                moderator=seat.moderator,
                locked=self.meeting.locked,
                hertz=HERTZ,
                recording=self._recorder is not None,
                replay=self._replay is not None,
                engine=self._switchboard is not None,
                shapes=BLENDSHAPES,
                people=self.meeting.people,
                ice=self._relays.servers(seat.id, now_s=time.time()) if page else (),
            )
        )
        if page:
            connection.tick(self.meeting.whole(now=time.monotonic()))
            if self._replay:
                connection.say(self._replay.playing(now=time.monotonic()))
            self._tell(Changed(person=seat.person), but=seat)
            if self._neighbours:
                self._neighbours.entered()
            if self._switchboard:
                self._switchboard.begin(seat.id, connection.say)
        return seat

    def go(self, seat: Seat, connection: Connection, role: Part) -> None:
        """A connection has ended; the place is kept for a while."""
        connections = self._connections(role)
        if connections.get(seat.id) is not connection:  # a newer one has taken its part
            return
        del connections[seat.id]
        if role == "page" and self._switchboard:
            self._switchboard.end(seat.id)
        if role == "face":
            seat.program_left()
        else:
            seat.gone_at, seat.voice = time.monotonic(), False
        if self.meeting.seat(seat.id) is seat:
            self._tell(Changed(person=seat.person))

    def move(self, seat: Seat, message: bytes, role: Part) -> None:
        """Take a state.

        Raises
        ------
        FormatError
            If the bytes are none.
        """
        if self.meeting.take(seat, message, program=role == "face", now=time.monotonic()):
            self._tell(Changed(person=seat.person))
        if self._neighbours:
            self._neighbours.took(seat.number, message, role)

    def hear(self, seat: Seat, said: Said) -> None:
        """Do what a person says.

        Raises
        ------
        NotAllowed
            If the rules forbid it.
        """
        match said:
            case Chat():
                self._write(seat, said.text)
            case Voice():
                seat.voice = said.open
                self._tell(Changed(person=seat.person))
            case Description() | Candidate():
                self._pass_on(seat, said)
            case Moderate():
                self._moderate(seat, said)
            case Consent():
                self._consent(seat, said.recorded)
            case Play():
                self._play(said)
            case Undress():
                self.cloakroom.undress(seat)
                self._tell(Changed(person=seat.person))
            case Share():
                for changed in self.meeting.share(seat, on=said.on):
                    self._tell(Changed(person=changed.person))
            case Leave():
                self._free(seat)

    def _consent(self, seat: Seat, recorded: bool) -> None:
        if self._recorder is None:
            raise NotAllowed("this room is not recorded")
        seat.recorded = recorded
        self._record_roster()
        self._tell(Changed(person=seat.person))

    def _play(self, said: Play) -> None:
        if self._replay is None:
            raise NotAllowed("people meet here; there is nothing to play")
        if not self._plays.take(now=time.monotonic()):
            raise NotAllowed("that was too fast; the replay goes on as it was", again=True)
        for answer in self._replay.play(said, self.meeting, now=time.monotonic()):
            self._tell(answer)

    def dress(self, seat: Seat, content: bytes) -> str:
        """Let somebody wear an avatar that was checked, and tell all; gives its digest.

        Raises
        ------
        NotAllowed
            If the server has no room for it; they wear the stand-in then.
        """
        try:
            self.cloakroom.dress(seat, content)
        finally:
            self._tell(Changed(person=seat.person))
        return seat.own

    def _undressed(self, id: str) -> None:
        seat = self.meeting.seat(id)
        if seat and seat.home == self.meeting.process:
            seat.undressed = True
            self.cloakroom.undress(seat)
            self._tell(Changed(person=seat.person))

    def _write(self, seat: Seat, text: str) -> None:
        if seat.muted:
            raise NotAllowed("a moderator has muted you", again=True)
        if text:
            line = Line(number=seat.number, name=seat.name, text=text, time_s=time.time())
            self._tell(line)
            if self._neighbours:
                self._neighbours.spoken(line)

    def tick(self, *, now: float) -> None:
        """Send what moved, and free places that nobody came back to."""
        for seat in self.meeting.expire(now=now):
            self._free(seat)
        if self._switchboard:
            self._switchboard.follow(self.meeting)
        if self._neighbours:
            self._neighbours.tick(now=now)
            self._follow()
        if self._replay:
            for answer in self._replay.step(self.meeting, now=now):
                self._tell(answer)
        content = self.meeting.tick(now=now)
        if content:
            if self._recorder:
                self._recorder.tick(content)
            for connection in self._pages.values():
                connection.tick(content)
        if self._recorder and not self._recorder.open:
            self._end_recording()

    def close(self) -> None:
        """Let go of what is replayed, of the other processes and of the engine."""
        if self._switchboard:
            self._switchboard.close()
        if self._replay:
            self._replay.close()
        if self._neighbours:
            self.cloakroom.close()
            self._neighbours.close()

    def _record_roster(self) -> None:
        if self._recorder:
            self._recorder.roster(self.meeting.people)

    def _end_recording(self) -> None:
        self._recorder = None
        self._tell(Notice(text="the recording has ended, and nobody is recorded any more"))
        for person in self.meeting.people:
            if person.recorded and (seat := self.meeting.seat(person.id)):
                seat.recorded = False
                self._tell(Changed(person=seat.person))

    def _connections(self, role: Part) -> dict[str, Connection]:
        return self._pages if role == "page" else self._programs

    def _tell(self, answer: Answer, *, but: Seat | None = None) -> None:
        """Tell all; what is true of people from now on goes to the other processes with the next account."""
        self._tell_here(answer, but=but)
        if self._neighbours:
            self._neighbours.changed()

    def _tell_here(self, answer: Answer, *, but: Seat | None = None) -> None:
        for id, connection in self._pages.items():
            if but is None or id != but.id:
                connection.say(answer)

    def _pass_on(self, seat: Seat, said: Description | Candidate) -> None:
        if isinstance(said.to, str):
            if self._switchboard:
                self._switchboard.hear(seat.id, said)
            return
        called, signal = self.meeting.numbered(said.to), Signal(sender=seat.number, signal=said)
        if called is None:
            return  # they have just left: the caller hears of that by the roster
        if said.plane == "screen" and not (seat.shares or called.shares):
            return  # sharing has just ended
        if called.id in self._pages:
            self._pages[called.id].say(signal)
        elif self._neighbours and called.home != self.meeting.process:
            self._neighbours.called(called.id, signal)

    def _call(self, id: str, signal: Signal) -> None:
        if connection := self._pages.get(id):
            connection.say(signal)

    def _oust(self, ousted: Ousted) -> None:
        self._turnstile.forget(ousted.id)
        self.cloakroom.drop(ousted.id)
        if self._switchboard:
            self._switchboard.end(ousted.id)
        if connection := self._pages.pop(ousted.id, None):
            connection.refuse(ousted.text, again=ousted.again)

    def _follow(self) -> None:
        """Let go of programs whose person has left by another process."""
        for id in [id for id in self._programs if self.meeting.seat(id) is None]:
            self._programs.pop(id).refuse("whose face this moves has left", again=True)
        self.cloakroom.settle()

    def _moderate(self, by: Seat, act: Moderate) -> None:
        seat = self.meeting.moderate(by, act)
        if seat is None:
            self._tell(Door(locked=self.meeting.locked))
        elif act.action == "undress":
            self.cloakroom.undress(seat)
            self._tell(Changed(person=seat.person))
            if self._neighbours and seat.home != self.meeting.process:
                self._neighbours.undressed(seat.id)
        elif act.action == "remove":
            self._free(seat, word="a moderator has removed you from this room")
        else:
            self._tell(Changed(person=seat.person))

    def _free(self, seat: Seat, *, word: str = "you have left") -> None:
        self.meeting.leave(seat)
        self._turnstile.forget(seat.id)
        if self._switchboard:
            self._switchboard.end(seat.id)
        self.cloakroom.uploads.pop(seat.id, None)
        self.cloakroom.undress(seat)
        self._record_roster()
        for connections in (self._pages, self._programs):
            if connection := connections.pop(seat.id, None):
                connection.refuse(word, again=False)
        self._tell(Left(number=seat.number))
