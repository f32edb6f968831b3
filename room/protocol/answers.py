"""Defines what a room answers, as JSON objects with a ``kind``: who is there, what has changed, what was said.

What people say themselves stands in `room.protocol.texts`.
"""

from typing import Annotated, Literal

from pydantic import StringConstraints

from room.protocol.texts import Candidate, Description, EngineLine, Number, RecordingId, Text


class Person(Text):
    """One line of the roster.

    ``number`` stands before each state of a tick; ``id`` is the same person's whenever they come back. ``recorded`` are
    those whose states go to the room's file, ``replayed`` those who come out of one; at most one ``shares``. ``own``
    is the SHA-256 of an avatar that they brought, which the room's key fetches (`room.server.avatar_requests`);
    ``avatar`` stands in for it until it is there.
    """

    number: Number
    id: str
    name: str
    avatar: str
    visit: str
    moderator: bool
    present: bool
    voice: bool
    muted: bool
    face: Literal["page", "program"]
    recorded: bool
    replayed: bool
    own: Annotated[str, StringConstraints(pattern=r"^([0-9a-f]{64})?$")] = ""
    shares: bool = False


class IceServer(Text):
    """Where a browser asks for its own address, or for a relay."""

    urls: tuple[str, ...]
    username: str | None = None
    credential: str | None = None


class Welcome(Text):
    """The first answer: who one is, who is there, and what the room allows; ``engine`` where voices go by one.

    ``recording`` is the id of what records the room; empty where nothing does.
    """

    kind: Literal["welcome"] = "welcome"
    version: Literal[1] = 1
    room: str
    number: Number
    id: str
    moderator: bool
    locked: bool
    hertz: int
    shapes: tuple[str, ...]
    recording: RecordingId
    replay: bool
    engine: bool
    people: tuple[Person, ...]
    ice: tuple[IceServer, ...]


class About(Text):
    """What a page may know before it comes in: what records the room, whether it plays a file, and how voices go."""

    recording: RecordingId
    replay: bool
    engine: bool


class Changed(Text):
    """Somebody came, came back, or is otherwise than before."""

    kind: Literal["person"] = "person"
    person: Person


class Left(Text):
    """Somebody has gone, and the number is free again."""

    kind: Literal["left"] = "left"
    number: Number


class Line(Text):
    """A line of chat, with who said it, whether they moderated then, and when (seconds since 1970)."""

    kind: Literal["line"] = "line"
    number: Number
    name: str
    moderator: bool = False
    text: str
    time_s: float


class Door(Text):
    """Whether new people may come in."""

    kind: Literal["door"] = "door"
    locked: bool


class Playing(Text):
    """Where a replay is now, how long it is, and how it goes on."""

    kind: Literal["playing"] = "playing"
    time_s: float
    length_s: float
    paused: bool
    speed: float


class Signal(Text):
    """A description or a candidate that came from somebody, or of one's own line."""

    kind: Literal["signal"] = "signal"
    sender: Number | EngineLine
    signal: Description | Candidate


class Engine(Text):
    """Voices go by an engine from now on and both lines begin anew, or it is away for a while."""

    kind: Literal["engine"] = "engine"
    state: Literal["ready", "away"]


class Heard(Text):
    """Whose voice each sound of the line down is from the next description on: the person's id by the ``mid``."""

    kind: Literal["heard"] = "heard"
    voices: dict[str, str]


class Notice(Text):
    """A word about what this person did, which had no effect; ``about`` is the kind of the text that was refused.

    Of a consent it says that the room is not recorded, or no longer: there is nothing to agree to.
    """

    kind: Literal["notice"] = "notice"
    text: str
    about: str = ""


class Refused(Text):
    """The last text before the room closes a connection, and why; ``again`` says whether trying again makes sense."""

    kind: Literal["refused"] = "refused"
    text: str
    again: bool


Answer = Welcome | Changed | Left | Line | Door | Playing | Signal | Engine | Heard | Notice | Refused
