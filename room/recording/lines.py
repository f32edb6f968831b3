"""Defines the lines of a recording: JSON objects with a ``kind``, one a line, in the order in which things happened.

The first is `Heading`. Then come `Came`, `Gone` and `Tick`, each with its time. No sound, picture or chat is kept.
Lines and not a table: one in Parquet ends with its index, so that a server that is killed would leave nothing to read.
"""

from typing import Annotated, Literal

from pydantic import Base64Bytes, BaseModel, ConfigDict, Field

from room.protocol.texts import Avatar, Name, Number, RoomName

MOST_RECORDING_BYTES = 1024**3
"""Of one file: eight people fill it in nine and a half hours. Then the recording ends, and the meeting goes on."""

MOST_LINE_BYTES = 8 * 1024**2
"""Of one line: 1,000 people after a second's stall, 32 states each, are half of it."""

MOST_AT_ONCE = 1000
"""People in it at one time: as many as `room serve --people` takes. A replay gives each a place."""

Time = Annotated[int, Field(ge=0, le=2**40)]
"""Milliseconds since the recording began, at most 34 years."""


class _Line(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Heading(_Line):
    """The first line: what is recorded; ``began_s`` in seconds since 1970."""

    kind: Literal["recording"] = "recording"
    version: Literal[1] = 1
    room: RoomName
    began_s: Annotated[float, Field(ge=0, allow_inf_nan=False)]
    hertz: Annotated[int, Field(ge=1, le=1000)]
    shapes: Annotated[tuple[Annotated[str, Field(max_length=40)], ...], Field(max_length=52)]


class Came(_Line):
    """From here on ``number`` is this person, or they are otherwise than before."""

    kind: Literal["came"] = "came"
    time_ms: Time
    number: Number
    id: Annotated[str, Field(pattern=r"^[0-9a-f]{16}$")]
    name: Name
    avatar: Avatar


class Gone(_Line):
    """Nobody has this number any more: they left, or wish no longer to be recorded."""

    kind: Literal["gone"] = "gone"
    time_ms: Time
    number: Number


class Tick(_Line):
    """States that the room sent together: the person's number, and a message of `room.protocol.message` in base64."""

    kind: Literal["tick"] = "tick"
    time_ms: Time
    states: Annotated[tuple[tuple[Number, Base64Bytes], ...], Field(max_length=65536)]


Event = Came | Gone | Tick
"""What follows the heading."""
