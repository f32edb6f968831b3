"""Reads what a browser asks for: bounded, typed, and refused in one sentence where it is something else."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, TypeAdapter, ValidationError

from facegen.conventions import BLENDSHAPES
from facegen.errors import InputError
from facegen.refusals import refusal
from track.messages import Command

MOST_MESSAGE_BYTES = 4096
"""Of one message from a browser; the longest that is meant, a gain, has some 60."""

MOST_GAIN = 4.0
"""What a shape is multiplied by: from 4 on a quarter of a smile is a whole one."""


@dataclass(frozen=True, kw_only=True)
class Seen:
    """A browser has drawn up to this frame."""

    number: int


class _Message(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class _Plain(_Message):
    verb: Literal["cancel", "recentre"]


class _Switch(_Message):
    verb: Literal["mirror", "record", "picture"]
    value: bool


class _Calibrate(_Message):
    verb: Literal["calibrate"]
    value: Annotated[str, Field(max_length=40)]


class _Gain(_Message):
    verb: Literal["gain"]
    shape: Annotated[str, Field(max_length=40)]
    value: Annotated[FiniteFloat, Field(ge=0, le=MOST_GAIN)]


class _Seen(_Message):
    verb: Literal["seen"]
    value: Annotated[int, Field(ge=0, lt=2**53)]


_MESSAGE = TypeAdapter(Annotated[_Plain | _Switch | _Calibrate | _Gain | _Seen, Field(discriminator="verb")])


def read_command(text: str, *, steps: Sequence[str]) -> Command | Seen:
    """The command in a browser's message.

    Parameters
    ----------
    text
        JSON of an object with ``verb``, and ``shape`` and ``value`` as `track.messages.Command` says; or the verb
        ``seen`` with a frame's number.
    steps
        Names of the steps of calibration.

    Raises
    ------
    InputError
        The message is something else; it says what, and what is allowed.
    """
    try:
        message = _MESSAGE.validate_json(text)
    except ValidationError as error:
        raise InputError(f"the message was not understood: {refusal(error, _Message)}") from None
    if isinstance(message, _Seen):
        return Seen(number=message.value)
    if isinstance(message, _Calibrate) and message.value not in (*steps, "all"):
        raise InputError(f"there is no step {message.value!r}; there are {', '.join((*steps, 'all'))}")
    if isinstance(message, _Gain) and message.shape not in BLENDSHAPES:
        raise InputError(f"there is no shape {message.shape!r}; the 52 ARKit names are known")
    return Command(**message.model_dump())
