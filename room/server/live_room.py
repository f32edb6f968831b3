"""Joins one room's state with its connections: who comes, moves and goes, and who hears of it."""

import time
from typing import TYPE_CHECKING

from facegen.conventions import BLENDSHAPES
from room.avatars import AvatarStore
from room.protocol.accounts import Part
from room.protocol.answers import Answer, Changed, Left, Signal, Welcome
from room.protocol.texts import Join, Said
from room.recording import Recorder
from room.server.avatar_transfer import AvatarTransfer
from room.server.calls import Calls
from room.server.commands import RoomCommands
from room.server.connection import Connection
from room.server.connections import Connections
from room.server.consents import Consents
from room.server.join_limit import JoinLimit
from room.server.peer_processes import PeerProcesses
from room.server.replay import Replay
from room.server.room_avatars import RoomAvatars
from room.server.room_voices import RoomVoices
from room.server.turn import Relays
from room.state import Meeting, Seat
from room.state.accounts import Ousted

if TYPE_CHECKING:  # needs an extra of its own
    from room.server.redis_channels import RedisChannels

HERTZ = 30
"""Ticks a second: as many as a camera has frames."""


class LiveRoom:
    """One room with its connections.

    Parameters
    ----------
    name
        Of the room.
    most_people
        Places.
    relays
        What browsers are told for their voices.
    store
        Keeps the avatars that people bring.
    recorder
        Takes the states of those who agreed; None where nobody is recorded.
    replay
        Brings people of a recording in; None for a room of the living alone.
    channels
        Reach the other processes that carry this room; None where there is one alone.
    transfer
        Brings own avatars from those processes, and to them; None where there is one alone.
    voices
        Passes voices on by an engine; None where they go from page to page.

    Attributes
    ----------
    avatars
        Has their own avatars.
    """

    def __init__(
        self,
        name: str,
        *,
        most_people: int,
        relays: Relays,
        store: AvatarStore,
        recorder: Recorder | None = None,
        replay: Replay | None = None,
        channels: "RedisChannels | None" = None,
        transfer: AvatarTransfer | None = None,
        voices: RoomVoices | None = None,
    ) -> None:
        self.name = name
        self._replay = replay
        process = channels.process if channels else ""
        self.meeting = Meeting(
            most_people=most_people, process=process, first_number=int(process[:4] or "0", 16)
        )
        self.avatars = RoomAvatars(name, self.meeting, store, transfer)
        self._connections = Connections()
        self._consents = Consents(self.meeting, recorder)
        self._calls = Calls(self.meeting, self._connections, voices, away=self._send_away)
        self._peers = channels and PeerProcesses(
            self.meeting,
            channels,
            name,
            broadcast=self._connections.broadcast,
            send_to=self._connections.send_to,
            oust=self._oust,
            take_off=self._take_off,
            send_piece=self.avatars.send,
        )
        self._commands = RoomCommands(
            self.meeting,
            avatars=self.avatars,
            consents=self._consents,
            calls=self._calls,
            replay=replay,
            peers=self._peers,
            broadcast=self._broadcast,
            free=self._free,
        )
        self._relays = relays
        self._join_limit = JoinLimit(most_people)

    @property
    def empty(self) -> bool:
        """Whether nobody of this process has a place or a connection."""
        return self.meeting.empty and self._connections.empty

    async def open(self) -> None:
        """Learn who is in the room by other processes.

        Raises
        ------
        NotAllowed
            If they cannot be reached.
        """
        if self._peers:
            await self._peers.open()

    def enter(self, join: Join, connection: Connection, *, moderator: bool) -> Seat:
        """Bring somebody in, and tell the others; an older connection of the same person is closed.

        Raises
        ------
        NotAllowed
            As `room.state.Meeting.enter`, or if people come in so often that others hear of nothing else.
        """
        self._join_limit.count(join, self.meeting, moderator=moderator)
        named = {person.id: person.name for person in self.meeting.people}
        seat = self.meeting.enter(join, moderator=moderator)
        self._connections.enter(seat.id, join.role, connection)
        page = join.role == "page"
        if page and not self.avatars.has(seat):
            seat.own = ""  # it stayed with the process that they came by before; their page brings it again
        if page:  # a program that moves a face has no say in this
            self._consents.enter(seat, recorded=join.recorded, recording=join.recording)
        connection.say(
            Welcome(
                room=self.name,
                number=seat.number,
                id=seat.id,
                moderator=seat.moderator,
                locked=self.meeting.locked,
                hertz=HERTZ,
                recording=self._consents.recording,
                replay=self._replay is not None,
                engine=self._calls.by_engine,
                shapes=BLENDSHAPES,
                people=self.meeting.people,
                ice=self._relays.servers(seat.id, now_s=time.time()) if page else (),
            )
        )
        if page:
            connection.tick(self.meeting.whole(now=time.monotonic()))
            if self._replay:
                connection.say(self._replay.playing(now=time.monotonic()))
            self._broadcast(Changed(person=seat.person), but=seat)
            for person in self.meeting.people:  # who lost their name to this one
                if person.id != seat.id and person.name != named[person.id]:
                    self._broadcast(Changed(person=person), but=seat)
            if self._peers:
                self._peers.entered()
            self._calls.begin(seat, connection.say)
        return seat

    def go(self, seat: Seat, connection: Connection, role: Part) -> None:
        """A connection has ended; the place is kept for a while."""
        if not self._connections.go(seat.id, role, connection):  # a newer one has taken its part
            return
        if role == "page":
            self._calls.end(seat.id)
        if role == "face":
            seat.program_left()
        else:
            seat.gone_at, seat.voice = time.monotonic(), False
        if self.meeting.seat(seat.id) is seat:
            self._broadcast(Changed(person=seat.person))

    def move(self, seat: Seat, message: bytes, role: Part) -> None:
        """Take a state.

        Raises
        ------
        FormatError
            If the bytes are none.
        """
        if self.meeting.take(seat, message, program=role == "face", now=time.monotonic()):
            self._broadcast(Changed(person=seat.person))
        if self._peers:
            self._peers.took(seat.number, message, role)

    def hear(self, seat: Seat, said: Said) -> None:
        """Do what a person says.

        Raises
        ------
        NotAllowed
            If the rules forbid it.
        """
        self._commands.do(seat, said)

    def put_on(self, seat: Seat, content: bytes) -> str:
        """Let somebody wear an avatar that was checked, and tell all; gives its digest.

        Raises
        ------
        NotAllowed
            If the server has no room for it; they go on to wear what they wore.
        """
        self.avatars.put_on(seat, content)
        self._broadcast(Changed(person=seat.person))
        return seat.own

    def _take_off(self, id: str) -> None:
        seat = self.meeting.seat(id)
        if seat:
            self.avatars.take_off(seat)
            self._broadcast(Changed(person=seat.person))

    def tick(self, *, now: float) -> None:
        """Send what moved, and free places that nobody came back to."""
        for seat in self.meeting.expire(now=now):
            self._free(
                seat, "whose face this moves is away", again=True
            )  # a page may come back, and is moved again
        self._calls.tick()
        if self._peers:
            self._peers.tick(now=now)
            self._connections.follow({seat.id for seat in self.meeting.seats})
            self.avatars.settle()
        if self._replay:
            for answer in self._replay.step(self.meeting, now=now):
                self._broadcast(answer)
        content = self.meeting.tick(now=now)
        if content:
            self._connections.tick(content)
        for answer in self._consents.tick(content):
            self._broadcast(answer)

    def close(self) -> None:
        """Let go of what is replayed, of the other processes and of the engine."""
        self._calls.close()
        if self._replay:
            self._replay.close()
        if self._peers:
            self.avatars.close()
            self._peers.close()

    def _broadcast(self, answer: Answer, *, but: Seat | None = None) -> None:
        """Tell all; what is true of people from now on goes to the other processes with the next account."""
        self._connections.broadcast(answer, but=but.id if but else "")
        if self._peers:
            self._peers.changed()

    def _send_away(self, id: str, signal: Signal) -> None:
        if self._peers:
            self._peers.called(id, signal)

    def _oust(self, ousted: Ousted) -> None:
        self._join_limit.forget(ousted.id)
        self.avatars.drop(ousted.id)
        self._calls.end(ousted.id)
        self._connections.oust(ousted.id, ousted.text, again=ousted.again)

    def _free(self, seat: Seat, word: str, *, again: bool = False) -> None:
        self.meeting.leave(seat)
        self._join_limit.forget(seat.id)
        self._calls.end(seat.id)
        self.avatars.uploads.pop(seat.id, None)
        self.avatars.take_off(seat)
        self._consents.follow()
        self._connections.part(seat.id, word, again=again)
        self._broadcast(Left(number=seat.number))
