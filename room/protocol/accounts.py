"""Defines what the processes of one room say to each other: accounts of their people, lines, calls, and states.

Every process says all that it knows of a room, again and again; whoever hears it takes what is newer than its own. So a
message that is lost costs a moment, and nothing has to be kept between them.
"""

from collections.abc import Sequence
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, StringConstraints, TypeAdapter, ValidationError

from facegen.refusals import refusal
from room.errors import FormatError
from room.protocol.answers import Line, Signal
from room.protocol.texts import Avatar, Name, Number, Visit
from room.protocol.tick import pack, unpack

MOST_WORD_BYTES = 1024**2
"""Of one message between processes: an account of 1,000 people, and as many mutes, removals and avatars that were taken
off, has 0.4 MB."""

MOST_RESIDENTS = 1000
"""People of one room at one process: as many places as ``--people`` allows."""

Process = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{16}$")]
"""Made anew by each process when it starts."""
Id = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{16}$")]
Count = Annotated[int, Field(ge=0, le=2**53)]
Digest = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]

Part = Literal["page", "face"]
_PARTS: dict[Part, bytes] = {"page": b"\1", "face": b"\2"}
"""First byte of states, by what sent them; texts begin with a brace."""
_PROCESS = slice(1, 17)


class _Word(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Resident(_Word):
    """Somebody whose place is kept by the process that speaks.

    ``entry`` grows with each of their comings; ``own`` is the SHA-256 of the avatar they brought, or
    nothing.
    """

    number: Number
    id: Id
    name: Name
    avatar: Avatar
    visit: Visit
    moderator: bool
    present: bool
    voice: bool
    entry: Count
    own: Digest | Literal[""] = ""


class Mute(_Word):
    """What moderators did last to somebody's voice; ``acts`` counts how often they did."""

    id: Id
    muted: bool
    acts: Count


class Account(_Word):
    """All that one process knows of a room; ``asks`` has every other say its own at once."""

    kind: Literal["account"] = "account"
    process: Process
    asks: bool = False
    people: Annotated[tuple[Resident, ...], Field(max_length=MOST_RESIDENTS)] = ()
    mutes: Annotated[tuple[Mute, ...], Field(max_length=MOST_RESIDENTS)] = ()
    removed: Annotated[tuple[Id, ...], Field(max_length=MOST_RESIDENTS)] = ()
    undressed: Annotated[tuple[Id, ...], Field(max_length=MOST_RESIDENTS)] = ()
    locked: bool = False
    locks: Count = 0
    sharer: Annotated[str, StringConstraints(pattern=r"^([0-9a-f]{16})?$")] = ""
    shares: Count = 0


class Spoken(_Word):
    """A line of chat, for the people of the other processes."""

    kind: Literal["spoken"] = "spoken"
    process: Process
    line: Line


class Called(_Word):
    """A signal of voices, for somebody at another process."""

    kind: Literal["called"] = "called"
    process: Process
    to: Id
    signal: Signal


class Wanted(_Word):
    """A process has people who look at an avatar that another one took; ``at`` says from which byte on."""

    kind: Literal["wanted"] = "wanted"
    process: Process
    digest: Digest
    at: Count


class Moves(BaseModel):
    """States as they came in since the last tick, each behind the person's number, sent by pages or by programs."""

    model_config = ConfigDict(frozen=True)

    process: Process
    part: Part
    states: tuple[tuple[int, bytes], ...]


Word = Account | Spoken | Called | Wanted
_WORD = TypeAdapter(Annotated[Word, Field(discriminator="kind")])
_MOVER = TypeAdapter(Process)


def pack_moves(process: str, part: Part, states: Sequence[tuple[int, bytes]]) -> bytes:
    """Bytes of `Moves`: what sent them, the process in ASCII, and a tick (`room.protocol.tick`)."""
    return _PARTS[part] + process.encode() + pack(states, time_ms=0)


def read_word(content: bytes) -> Word | Moves:
    """Read what another process said.

    Raises
    ------
    FormatError
        If it is too long, or none of these.
    """
    if len(content) > MOST_WORD_BYTES:
        raise FormatError(f"a process says {len(content):,} bytes at once; {MOST_WORD_BYTES:,} are allowed")
    try:
        for part, mark in _PARTS.items():
            if content.startswith(mark):
                process = _MOVER.validate_python(content[_PROCESS].decode("ascii", "replace"))
                _, states = unpack(content[_PROCESS.stop :])
                return Moves.model_construct(process=process, part=part, states=tuple(states))
        return _WORD.validate_json(content)
    except ValidationError as error:
        raise FormatError(f"a process says what is not known here: {refusal(error, _Word)}") from None
