"""Holds the open connections of one room by the person's id: their page, and a program that moves their face."""

from collections.abc import Container

from room.protocol.accounts import Part
from room.protocol.answers import Answer, Signal
from room.server.connection import Connection


class Connections:
    """The connections of the people whose pages or programs are at this process."""

    def __init__(self) -> None:
        self._open: dict[Part, dict[str, Connection]] = {"page": {}, "face": {}}

    @property
    def empty(self) -> bool:
        """Whether there is none."""
        return not any(self._open.values())

    def enter(self, id: str, part: Part, connection: Connection) -> None:
        """Take somebody's connection; an older one of the same part is closed."""
        connections = self._open[part]
        if older := connections.pop(id, None):
            older.refuse("you came in from another window", again=False)
        connections[id] = connection

    def go(self, id: str, part: Part, connection: Connection) -> bool:
        """A connection has ended; says whether it still was the one of its part, and no newer one has taken that."""
        connections = self._open[part]
        if connections.get(id) is not connection:
            return False
        del connections[id]
        return True

    def broadcast(self, answer: Answer, *, but: str = "") -> None:
        """Say something to all pages; ``but`` is the id of whoever knows it already."""
        for id, connection in self._open["page"].items():
            if id != but:
                connection.say(answer)

    def send_to(self, id: str, signal: Signal) -> bool:
        """Pass on to one person's page what another browser says; says whether the page is here."""
        connection = self._open["page"].get(id)
        if connection:
            connection.pass_on(signal)
        return connection is not None

    def tick(self, content: bytes) -> None:
        """Send a tick to all pages."""
        for connection in self._open["page"].values():
            connection.tick(content)

    def oust(self, id: str, text: str, *, again: bool) -> None:
        """Close the page of somebody who is at another process now; their program may move them from here."""
        self._refuse(id, "page", text, again=again)

    def part(self, id: str, text: str, *, again: bool) -> None:
        """Close all connections of somebody whose place is free; ``again`` where they may come back to it."""
        for part in self._open:
            self._refuse(id, part, text, again=again)

    def follow(self, there: Container[str]) -> None:
        """Let go of programs whose person has left by another process; ``there`` has the ids of all who are in."""
        for id in [id for id in self._open["face"] if id not in there]:
            self._refuse(id, "face", "whose face this moves has left", again=True)

    def _refuse(self, id: str, part: Part, text: str, *, again: bool) -> None:
        if connection := self._open[part].pop(id, None):
            connection.refuse(text, again=again)
