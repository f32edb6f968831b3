"""Reads JSON documents of strangers, and checks them against typed records: one sentence says what is refused."""

import math
import re
from collections.abc import Iterator
from functools import cache
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from facegen.documents import MOST_JSON_BYTES, load_json
from facegen.refusals import refusal
from regress.errors import InputError

if TYPE_CHECKING:
    from pydantic import TypeAdapter

Record = TypeVar("Record")

LARGEST = 1e100
"""Of a number in a document, either way: its square is still a number, and no figure of a training comes near."""

_HALF = re.compile("[\ud800-\udfff]")
"""Of a surrogate pair, which JSON can escape one by one and UTF-8 cannot hold."""

_WHOLE = 2**63
"""From here on, a whole number is none that arrays hold."""


def read_document(path: str | PathLike[str], *, most_bytes: int = MOST_JSON_BYTES) -> dict[str, Any]:
    """Read a JSON object in which every number can be computed with and every text can be written again.

    Parameters
    ----------
    most_bytes
        Larger files are not read.

    Raises
    ------
    InputError
        Where the file is missing, too large or no JSON object, a number is not finite or beyond `LARGEST`, or a text
        holds half of a character.
    """
    document = load_json(Path(path), most_bytes=most_bytes)
    if not isinstance(document, dict):
        raise InputError(f"{path} holds {type(document).__name__}; a JSON object is needed")
    place = next(_unusable(document), None)
    if place is not None:
        raise InputError(
            f"{path}: {place.lstrip('.') or 'a key'} is a number that is not finite or beyond {LARGEST:g}, or a text "
            f"with half of a character; neither can be used"
        )
    return document


def _unusable(value: object, place: str = "") -> Iterator[str]:
    """Places of values that no arithmetic and no file can take."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from _unusable(key, place)
            yield from _unusable(inner, f"{place}.{key}" if key.isprintable() else place)
    elif isinstance(value, list):
        for number, inner in enumerate(value):
            yield from _unusable(inner, f"{place}[{number}]")
    elif isinstance(value, str):
        if not value.isascii() and _HALF.search(value):
            yield place
    elif isinstance(value, float):
        if not (math.isfinite(value) and abs(value) <= LARGEST):
            yield place
    elif isinstance(value, int) and abs(value) >= _WHOLE:
        yield place


def checked(kind: type[Record], document: object) -> Record:
    """A record of parsed JSON.

    Parameters
    ----------
    kind
        A dataclass; its fields' types say what is allowed.
    document
        What `read_document` gave.

    Raises
    ------
    InputError
        Names each refused key, its value and what is allowed.
    """
    from pydantic import ValidationError

    try:
        return _adapter(kind).validate_python(document)
    except ValidationError as error:
        raise InputError(refusal(error, kind)) from error


@cache
def _adapter(kind: type[Record]) -> "TypeAdapter[Record]":
    from pydantic import TypeAdapter  # here, as importing it takes 70 ms that `import regress` need not

    return TypeAdapter(kind)
