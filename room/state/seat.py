"""Keeps what a room knows of one person: who they are, and where and how they were last."""

from dataclasses import dataclass, field
from typing import Literal

from room.protocol import Flag
from room.protocol.answers import Person

PROGRAM_LASTS_S = 1.0
"""A program that is silent for longer has lost the face: the page moves it again. Thirty messages came in this time."""

MOST_AT_ONCE = 32
"""Messages of one person in one tick: two come when clocks beat, 30 after a second's stall; then the newest count."""

_FLAGS = 1
_BODY = 78
"""Where flags, and body with heading and animation, begin in a message (`room.protocol.message`)."""


@dataclass(kw_only=True)
class Seat:
    """One person in one room.

    Parameters
    ----------
    number
        What stands before their states.
    id
        The same whenever they come back.
    gone_at
        When the page's connection ended, in the room's seconds; None while it is there.
    recorded
        Whether they agreed to be, in a room that is.
    replayed
        Whether they come out of a recording: nobody's page or voice is behind them.
    shares
        Whether their window or picture is on the room's screens.
    home
        Process at which their page is.
    entry
        Grows with each of their comings, by whatever process: a time of their own clock in ms, or one more than before.
    own
        SHA-256 of the avatar that they brought; empty where they wear one of the server's.
    """

    number: int
    id: str
    name: str
    avatar: str
    visit: str
    moderator: bool
    gone_at: float | None = None
    voice: bool = False
    muted: bool = False
    recorded: bool = False
    replayed: bool = False
    shares: bool = False
    home: str = ""
    entry: int = 0
    own: str = ""
    _waiting: list[bytes] = field(default_factory=list)
    _page: bytes | None = None
    _program: bytes | None = None
    _program_at: float = float("-inf")

    @property
    def face(self) -> Literal["page", "program"]:
        """Who moves the face."""
        return "program" if self._program else "page"

    @property
    def person(self) -> Person:
        """Their line of the roster."""
        return Person(
            number=self.number,
            id=self.id,
            name=self.name,
            avatar=self.avatar,
            visit=self.visit,
            moderator=self.moderator,
            present=self.gone_at is None,
            voice=self.voice,
            muted=self.muted,
            face=self.face,
            recorded=self.recorded,
            replayed=self.replayed,
            own=self.own,
            shares=self.shares,
        )

    def take(self, message: bytes, *, program: bool, now: float) -> bool:
        """Keep a message that was checked; says whether another moves the face from now on."""
        before = self.face
        if program:
            self._program, self._program_at = message, now
            self._wait()
        else:
            self._page = message
            if now - self._program_at > PROGRAM_LASTS_S:
                self._program = None
            # while a program moves the face, its clock alone counts: what the page says goes out with its next message
            if self._program is None:
                self._wait()
        return self.face != before

    def mute(self, muted: bool) -> None:
        """Take the speaking sign away, or give it back."""
        self.muted = muted
        self._wait()

    def taken(self) -> list[bytes]:
        """What came since the last call, oldest first."""
        waiting, self._waiting = self._waiting, []
        return waiting

    @property
    def page_state(self) -> bytes | None:
        """What the page said last, whoever moves the face; None before the first."""
        return self._page

    def _wait(self) -> None:
        if (state := self.state) is not None:
            self._waiting = [*self._waiting, state][-MOST_AT_ONCE:]

    def program_left(self) -> None:
        """Give the face back to the page."""
        self._program, self._program_at = None, float("-inf")

    @property
    def state(self) -> bytes | None:
        """The message to send for them; None before the first."""
        page, program = self._page, self._program
        if program is None:
            state = page
        elif page is None:
            state = program
        else:
            flags = program[_FLAGS] & Flag.TRACKED | page[_FLAGS] & ~Flag.TRACKED
            state = b"".join((program[:_FLAGS], bytes((flags,)), program[_FLAGS + 1 : _BODY], page[_BODY:]))
        if state is None or not (self.muted and state[_FLAGS] & Flag.SPEAKING):
            return state
        return b"".join((state[:_FLAGS], bytes((state[_FLAGS] & ~Flag.SPEAKING,)), state[_FLAGS + 1 :]))
