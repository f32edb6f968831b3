"""Shares one room with the other processes that serve it: sends what happens here, and takes in what happens there."""

import asyncio
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from room.errors import FormatError
from room.protocol.accounts import (
    Account,
    Called,
    Moves,
    Part,
    Spoken,
    Wanted,
    Word,
    pack_moves,
    read_word,
)
from room.protocol.answers import Answer, Changed, Line, Signal
from room.state import Meeting
from room.state.accounts import SILENT_S, Ousted, account, merge, silent

if TYPE_CHECKING:  # needs an extra of its own
    from room.server.redis_channels import RedisChannels

AGAIN_S = 2.0
"""An account is said again after this time though nothing changed, so that one that was lost is made good."""

SOON_S = 0.1
"""Shortest time between two accounts of what changes while people are in."""

ANSWERS_S = 3.0
"""Time for the other processes to say who is there; one that is silent for so long is not waited for. All that answer
are counted, so it passes only where one hangs: half a second was too short on a machine of load 15, and let a newcomer
past a lock."""


class PeerProcesses:
    """The other processes of one room.

    Parameters
    ----------
    meeting
        The room.
    channels
        Reach them.
    room
        Its name.
    broadcast
        Called with what all people of this process have to hear.
    send_to
        Called with a signal for one of them, by id.
    oust
        Called with those of them who have to go.
    take_off
        Called with the id of somebody of this process whose own avatar a moderator of another one has taken off.
    send_piece
        Called with a piece of an avatar that another process wants.
    """

    def __init__(
        self,
        meeting: Meeting,
        channels: "RedisChannels",
        room: str,
        *,
        broadcast: Callable[[Answer], None],
        send_to: Callable[[str, Signal], None],
        oust: Callable[[Ousted], None],
        take_off: Callable[[str], None],
        send_piece: Callable[[Wanted], None],
    ) -> None:
        self._meeting, self._channels, self._room = meeting, channels, room
        self._broadcast, self._send_to, self._oust = broadcast, send_to, oust
        self._take_off, self._send_piece = take_off, send_piece
        self._heard_at: dict[str, float] = {}
        self._came: dict[Part, list[tuple[int, bytes]]] = {"page": [], "face": []}
        self._changed, self._said_at = True, float("-inf")
        self._answered = asyncio.Event()
        self._connected = False

    async def open(self) -> None:
        """Learn who is there, from all processes that have the room.

        Raises
        ------
        NotAllowed
            If they cannot be reached: who came in alone might pass a lock.
        """
        await self._channels.join(self._room, self.hear)
        self._connected = True
        others = await self._channels.ask(self._room, _bytes(account(self._meeting, asks=True))) - 1
        until = time.monotonic() + ANSWERS_S
        while len(self._heard_at) < others and (left := until - time.monotonic()) > 0:
            self._answered.clear()
            try:
                await asyncio.wait_for(self._answered.wait(), left)
            except asyncio.TimeoutError:
                break

    def close(self) -> None:
        """Say that nobody is left here, and hear no more."""
        self._say(account(self._meeting))
        self._channels.leave(self._room)

    def changed(self) -> None:
        """Somebody of this process is otherwise than before."""
        self._changed = True

    def entered(self) -> None:
        """Somebody has come in here: it is told at once, so that who goes on to another process is newer there."""
        self._changed, self._said_at = False, time.monotonic()
        self._say(account(self._meeting))

    def took(self, number: int, message: bytes, part: Part) -> None:
        """Somebody of this process has moved."""
        if self._heard_at:
            self._came[part].append((number, message))

    def spoken(self, line: Line) -> None:
        """Somebody of this process has written a line."""
        self._say(Spoken(process=self._meeting.process, line=line))

    def called(self, to: str, signal: Signal) -> None:
        """Somebody of this process calls somebody of another one, who has to know first who shares."""
        if self._changed:
            self.entered()
        self._say(Called(process=self._meeting.process, to=to, signal=signal))

    def tick(self, *, now: float) -> None:
        """Say what has come since the last tick, and what has changed."""
        back = self._channels.connected and not self._connected
        self._connected = self._channels.connected
        if back or now - self._said_at > (SOON_S if self._changed else AGAIN_S):
            self._changed, self._said_at = False, now
            self._say(account(self._meeting, asks=back))
        for part, states in self._came.items():
            if states:
                self._channels.say(self._room, pack_moves(self._meeting.process, part, states))
                states.clear()
        for process, at in list(self._heard_at.items()):
            if now - at > SILENT_S:
                del self._heard_at[process]
                for answer in silent(self._meeting, process, now=now):
                    self._broadcast(answer)

    def hear(self, content: bytes) -> None:
        """Take in what another process says; what is none of ours is let alone."""
        try:
            word = read_word(content)
        except FormatError:
            return
        if word.process == self._meeting.process:
            return
        match word:
            case Account():
                self._merge(word)
            case Moves():
                self._move(word)
            case Spoken():
                self._broadcast(word.line)
            case Called():
                self._send_to(word.to, word.signal)
            case Wanted():
                self._send_piece(word)

    def _merge(self, said: Account) -> None:
        now = time.monotonic()
        known = said.process in self._heard_at
        self._heard_at[said.process] = now
        merged = merge(self._meeting, said, now=now)
        for ousted in merged.ousted:
            self._oust(ousted)
        for id in merged.undressed:
            self._take_off(id)
        for answer in merged.told:
            self._broadcast(answer)
        if said.asks or not known:
            self._said_at = now
            self._say(account(self._meeting))
        if said.asks:
            states = [
                (seat.number, state)
                for seat in self._meeting.seats
                if seat.home == self._meeting.process and (state := seat.page_state) is not None
            ]
            if states:
                self._channels.say(self._room, pack_moves(self._meeting.process, "page", states))
        self._answered.set()

    def _move(self, moves: Moves) -> None:
        now, program = time.monotonic(), moves.part == "face"
        seats = {seat.number: seat for seat in self._meeting.seats}
        for number, message in moves.states:
            seat = seats.get(number)
            # a page's states come from where the page is; a program may have come in anywhere
            if seat and (program or seat.home == moves.process):
                if seat.take(message, program=program, now=now):
                    self._broadcast(Changed(person=seat.person))

    def _say(self, word: Word) -> None:
        self._channels.say(self._room, _bytes(word))


def _bytes(word: Word) -> bytes:
    return word.model_dump_json().encode()
