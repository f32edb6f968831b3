"""Keeps the voices of one room on its Janus: lines for whoever has the page open, and new ones when Janus is back."""

import asyncio
from collections.abc import Callable

from room.protocol.answers import Answer, Engine
from room.protocol.texts import Candidate, Description
from room.server.janus import Janus
from room.server.person_voice import PersonVoice
from room.server.voice_room import VoiceRoom, clear
from room.state import Meeting


class RoomVoices:
    """The voices of one room, of those whose pages are at this process.

    Parameters
    ----------
    janus
        The instance that has the room.
    room
        At Janus.
    """

    def __init__(self, janus: Janus, room: VoiceRoom) -> None:
        self._janus, self._room = janus, room
        self._pages: dict[str, Callable[[Answer], None]] = {}
        self._voices: dict[str, PersonVoice] = {}
        janus.watchers.add(self._turn)

    def begin(self, id: str, say: Callable[[Answer], None]) -> None:
        """Give lines to somebody whose page has come, in place of older ones; ``say`` sends to the page."""
        self.end(id)
        self._pages[id] = say
        if self._janus.up:
            self._voices[id] = PersonVoice(self._janus, self._room, id, say=say)
        else:
            say(Engine(state="away"))

    def end(self, id: str) -> None:
        """Take the lines of somebody whose page has gone."""
        self._pages.pop(id, None)
        if voice := self._voices.pop(id, None):
            voice.close()

    def hear(self, id: str, said: Description | Candidate) -> None:
        """Take what a page says to one of its lines."""
        if voice := self._voices.get(id):
            voice.hear(said)

    def follow(self, meeting: Meeting) -> None:
        """Do to voices what moderators did to people."""
        for id, voice in self._voices.items():
            if seat := meeting.seat(id):
                voice.mute(seat.muted)

    def close(self) -> None:
        """End with the room."""
        self._janus.watchers.discard(self._turn)
        for id in list(self._pages):
            self.end(id)
        self._clearing = asyncio.ensure_future(clear(self._janus, self._room))

    def _turn(self, up: bool) -> None:
        """Begin all lines anew, or say that there are none."""
        for id, say in list(self._pages.items()):
            self.begin(id, say)
