"""Passes on what browsers say to each other of their voices and screens, to the person or the engine that is meant."""

from collections.abc import Callable

from room.protocol.answers import Answer, Signal
from room.protocol.texts import Candidate, Description
from room.server.connections import Connections
from room.server.room_voices import RoomVoices
from room.state import Meeting, Seat


class Calls:
    """The calls of one room.

    Parameters
    ----------
    meeting
        Who is in the room.
    connections
        Of those who are at this process.
    voices
        Passes voices on by an engine; None where they go from page to page.
    away
        Called with a signal for somebody at another process, by id.
    """

    def __init__(
        self,
        meeting: Meeting,
        connections: Connections,
        voices: RoomVoices | None,
        *,
        away: Callable[[str, Signal], None],
    ) -> None:
        self._meeting, self._connections, self._voices = meeting, connections, voices
        self._away = away

    @property
    def by_engine(self) -> bool:
        """Whether an engine passes voices on."""
        return self._voices is not None

    def begin(self, seat: Seat, say: Callable[[Answer], None]) -> None:
        """Give lines to an engine to somebody whose page has come; ``say`` sends to it."""
        if self._voices:
            self._voices.begin(seat.id, say)

    def end(self, id: str) -> None:
        """Take the lines of somebody whose page has gone."""
        if self._voices:
            self._voices.end(id)

    def pass_on(self, seat: Seat, said: Description | Candidate) -> None:
        """Give what somebody's browser says to whom it is for."""
        if isinstance(said.to, str):
            if self._voices:
                self._voices.hear(seat.id, said)
            return
        called, signal = self._meeting.numbered(said.to), Signal(sender=seat.number, signal=said)
        if called is None:
            return  # they have just left: the caller hears of that by the roster
        if said.plane == "screen" and not (seat.shares or called.shares):
            return  # sharing has just ended
        if not self._connections.send_to(called.id, signal) and called.home != self._meeting.process:
            self._away(called.id, signal)

    def tick(self) -> None:
        """Do to voices what moderators did to people."""
        if self._voices:
            self._voices.follow(self._meeting)

    def close(self) -> None:
        """End with the room."""
        if self._voices:
            self._voices.close()
