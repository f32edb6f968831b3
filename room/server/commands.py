"""Carries out what the people of one room ask by text: chat, microphones, consent, screens, replays, moderation."""

import time
from collections.abc import Callable

from room.errors import NotAllowed
from room.protocol.answers import Answer, Changed, Door, Line
from room.protocol.texts import (
    Candidate,
    Chat,
    Consent,
    Description,
    Leave,
    Moderate,
    Play,
    Said,
    Share,
    Undress,
    Voice,
)
from room.server.calls import Calls
from room.server.consents import Consents
from room.server.peer_processes import PeerProcesses
from room.server.replay import Replay
from room.server.room_avatars import RoomAvatars
from room.state import Meeting, Seat


class RoomCommands:
    """What a person in the room may do by a text.

    Parameters
    ----------
    meeting
        Who is in the room.
    avatars, consents, calls
        Its own avatars, its recording, and its voices and screens.
    replay
        What the room plays; None where people meet.
    peers
        The other processes of the room; None where there are none.
    broadcast
        Called with what all have to hear.
    free
        Called with somebody who goes for good, and the word that closes their page.
    """

    def __init__(
        self,
        meeting: Meeting,
        *,
        avatars: RoomAvatars,
        consents: Consents,
        calls: Calls,
        replay: Replay | None,
        peers: PeerProcesses | None,
        broadcast: Callable[[Answer], None],
        free: Callable[[Seat, str], None],
    ) -> None:
        self._meeting, self._avatars, self._consents, self._calls = meeting, avatars, consents, calls
        self._replay, self._peers = replay, peers
        self._broadcast, self._free = broadcast, free

    def do(self, seat: Seat, said: Said) -> None:
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
                changes, seat.voice = seat.voice != said.open, said.open
                self._tell(seat, changes)
            case Description() | Candidate():
                self._calls.pass_on(seat, said)
            case Moderate():
                self._moderate(seat, said)
            case Consent():
                self._tell(seat, self._consents.change(seat, recorded=said.recorded))
            case Play():
                self._play(said)
            case Undress():
                changes = bool(seat.own)
                self._avatars.take_off(seat)
                self._tell(seat, changes)
            case Share():
                for changed in self._meeting.share(seat, on=said.on):
                    self._broadcast(Changed(person=changed.person))
            case Leave():
                self._free(seat, "you have left")

    def _tell(self, seat: Seat, changes: bool) -> None:
        """Tell all of somebody who is otherwise now: what changes nothing is told to nobody."""
        if changes:
            self._broadcast(Changed(person=seat.person))

    def _play(self, said: Play) -> None:
        if self._replay is None:
            raise NotAllowed("people meet here; there is nothing to play")
        for answer in self._replay.play(said, self._meeting, now=time.monotonic()):
            self._broadcast(answer)

    def _write(self, seat: Seat, text: str) -> None:
        if seat.muted:
            raise NotAllowed("a moderator has muted you", again=True)
        if text:
            line = Line(
                number=seat.number,
                name=seat.name,
                moderator=seat.moderator,
                text=text,
                time_s=time.time(),
            )
            self._broadcast(line)
            if self._peers:
                self._peers.spoken(line)

    def _moderate(self, by: Seat, act: Moderate) -> None:
        seat = self._meeting.moderate(by, act)
        if seat is None:
            self._broadcast(Door(locked=self._meeting.locked))
        elif act.action == "undress":
            self._avatars.take_off(seat)
            self._broadcast(Changed(person=seat.person))
        elif act.action == "remove":
            self._free(seat, "a moderator has removed you from this room")
        else:
            self._broadcast(Changed(person=seat.person))
