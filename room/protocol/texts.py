"""Defines what a person may say in a meeting: texts, which are JSON objects with a ``kind``.

A connection to ``/room/NAME/socket`` begins with `Join`; the room answers (`room.protocol.answers`) with `Welcome`, or
with `Refused` and closes.
After that states go both ways as binary messages (`room.protocol.message`, `room.protocol.tick`), and texts as here.

A program that moves somebody's face (``track --to room:LINK``) joins with ``role`` "face" and the person's own secret.
It sends states, of which the room takes weights, head and gaze; body, speech and gestures stay the page's.
The link of a room is ``SCHEME://HOST:PORT/room/NAME#KEY``, and that of somebody's face ends with ``#KEY.SECRET``.
What is behind the ``#`` is never part of a request: it comes in `Join` alone.
"""

import re
import unicodedata
from typing import Annotated, Literal

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StringConstraints,
    TypeAdapter,
    ValidationError,
    field_validator,
)

from facegen.refusals import refusal
from room.errors import FormatError

MOST_TEXT_BYTES = 64 * 1024
"""Of one text; a session description of a voice with all its codecs has 3 kB, an answer to 64 voices 49 kB."""

MOST_CHAT_CHARACTERS = 500
"""Of one line of chat."""

MOST_NAME_CHARACTERS = 40
"""Of a person's name, as it stands above a head."""

_BREAKS = r"\x00-\x1f\x7f-\x9f\u2028\u2029"
_UNSEEN = (
    r"\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b\u200e\u200f\u202a-\u202e\u2060-\u206f\u2800\u3164"
    r"\ufe00-\ufe0e\ufeff\uffa0\ufff0-\ufffb\U000e0000-\U000e0fff"
)
"""What turns the direction of writing, or has no width or no ink, so that two names look the same."""

_JOINED = r"[\u0600-\u1fff\u2070-\ufdff\ufe10-\U0010ffff]"
_LOOSE = re.compile(
    f"(?<!{_JOINED})[\u200c\u200d]|[\u200c\u200d](?!{_JOINED})|(?<![\u00a9\u00ae\u2000-\U0010ffff])\ufe0f(?!\u20e3)"
)
"""Signs that join or part letters of Persian and India, and make emoji: elsewhere nobody sees them."""


def _line(text: str) -> str:
    """What is seen of a text in one line: people paste what they cannot see, and that must cost them nothing."""
    seen = re.sub(f"[{_UNSEEN}]", "", re.sub(f"[{_BREAKS}]+", " ", text))
    while (clean := _LOOSE.sub("", seen)) != seen:  # one may have stood beside another
        seen = clean
    return seen.strip() if any(unicodedata.category(each)[0] in "LNPS" for each in seen) else ""


Name = Annotated[
    str,
    BeforeValidator(lambda text: _line(text) if isinstance(text, str) else text),
    StringConstraints(
        strip_whitespace=True,
        min_length=1,
        max_length=MOST_NAME_CHARACTERS,
        pattern=f"^[^{_BREAKS}{_UNSEEN}]*$",
    ),
]
"""A line that people see above a head: without control characters, and nothing `_UNSEEN`."""
Secret = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9_-]{22,64}$")]
"""At least 128 bits in base64url, made by whoever joins: who has it is that person."""
Key = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9_-]{22}$")]
Number = Annotated[int, Field(ge=0, le=65535)]
EngineLine = Literal["up", "down"]
"""One's own voice to an engine in the middle (`room.server.person_voice`), and the others' voices from it."""
Avatar = Annotated[str, StringConstraints(pattern=r"^[a-z0-9_-]{1,32}$")]
Visit = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9_-]{0,22}$")]
"""Made anew whenever a page is loaded: the same one after a break means that voices go on."""
RecordingId = Annotated[str, StringConstraints(pattern=r"^([0-9a-f]{16})?$")]
"""Of one recording, made anew with its file; empty where there is none. A yes to one is none to the next."""
RoomName = Annotated[str, StringConstraints(pattern=r"^[a-z0-9][a-z0-9-]{0,39}$")]


class Text(BaseModel):
    """What every text has in common: nothing unknown in it, and nothing of another type."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Join(Text):
    """The first text of a connection; ``recorded`` says that this person agrees to be recorded, by ``recording`` alone.

    ``at_ms`` is the time of this coming by the person's own clock: of two servers that do not know of each other's yet,
    the later one has them.
    """

    kind: Literal["join"] = "join"
    version: Literal[1] = 1
    key: Key
    secret: Secret
    name: Name
    avatar: Avatar = "plain"
    visit: Visit = ""
    role: Literal["page", "face"] = "page"
    recorded: bool = False
    recording: RecordingId = ""
    at_ms: Annotated[int, Field(ge=0, le=2**52)] = 0


class Chat(Text):
    """A line for all; empty where nothing of it is seen."""

    kind: Literal["chat"] = "chat"
    text: Annotated[
        str, StringConstraints(strip_whitespace=True, min_length=1, max_length=MOST_CHAT_CHARACTERS)
    ]

    _seen = field_validator("text")(_line)


class Voice(Text):
    """Whether this person's microphone is open."""

    kind: Literal["voice"] = "voice"
    open: bool


Plane = Literal["voice", "screen"]
"""Which of two connections between two people a signal is for; only who shares has the second one."""


class Description(Text):
    """A session description of WebRTC, for one person, or for one's own line to or from an engine of voices."""

    kind: Literal["description"] = "description"
    plane: Plane = "voice"
    to: Number | EngineLine
    type: Literal["offer", "answer", "rollback"]
    sdp: str


class Candidate(Text):
    """An address at which a person may be reached, for one person or a line; empty where there are no more."""

    kind: Literal["candidate"] = "candidate"
    plane: Plane = "voice"
    to: Number | EngineLine
    candidate: Annotated[str, StringConstraints(max_length=1024)]
    mid: Annotated[str, StringConstraints(max_length=64)] | None = None
    line: Annotated[int, Field(ge=0, le=64)] | None = None


class Moderate(Text):
    """What a moderator does; ``number`` is to whom, and means nothing for ``lock`` and ``unlock``.

    ``id`` is that person's, where it is given: a number may be another's by the time the text arrives.
    """

    kind: Literal["moderate"] = "moderate"
    action: Literal["mute", "unmute", "undress", "unshare", "remove", "lock", "unlock"]
    number: Number | None = None
    id: Annotated[str, StringConstraints(max_length=64)] = ""


class Consent(Text):
    """Agrees to be recorded from now on, or no longer."""

    kind: Literal["consent"] = "consent"
    recorded: bool


class Play(Text):
    """What somebody who looks at a replay asks of it; None leaves as it is. Seconds from its beginning."""

    kind: Literal["play"] = "play"
    paused: bool | None = None
    time_s: Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)] | None = None
    speed: Annotated[float, Field(ge=0.1, le=8)] | None = None


class Undress(Text):
    """Takes the avatar off that one brought: the one of the server's is worn again."""

    kind: Literal["undress"] = "undress"


class Share(Text):
    """Shows a window or a picture on the room's screens from now on, or no longer."""

    kind: Literal["share"] = "share"
    on: bool


class Leave(Text):
    """Goes for good: the place is not kept."""

    kind: Literal["leave"] = "leave"


Said = Chat | Voice | Description | Candidate | Moderate | Consent | Play | Undress | Share | Leave
"""What a person may say once they are in."""


_JOIN = TypeAdapter(Join)
_SAID = TypeAdapter(Annotated[Said, Field(discriminator="kind")])


def read_join(content: str) -> Join:
    """Read the first text of a connection.

    Raises
    ------
    FormatError
        If it is too long, no JSON, or no `Join`.
    """
    return _read(_JOIN, content, Join)


def read_said(content: str) -> Said:
    """Read what a person says once they are in.

    Raises
    ------
    FormatError
        If it is too long, no JSON, or none of `Said`.
    """
    return _read(_SAID, content, Text)


def _read(adapter: TypeAdapter, content: str, record: type) -> object:
    # a character has at most four bytes; counting them exactly would copy the text
    if len(content) > MOST_TEXT_BYTES:
        raise FormatError(
            f"a text has at most {MOST_TEXT_BYTES:,} characters, and this one has {len(content):,}"
        )
    try:
        return adapter.validate_json(content)
    except ValidationError as error:
        raise FormatError(f"a text that is not understood: {refusal(error, record)}") from None
