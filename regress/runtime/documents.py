"""Checks JSON data against typed records: pydantic reads, and one sentence says what it refuses."""

from functools import cache
from typing import TYPE_CHECKING, TypeVar

from facegen.refusals import refusal
from regress.errors import InputError

if TYPE_CHECKING:
    from pydantic import TypeAdapter

Record = TypeVar("Record")


def checked(kind: type[Record], document: object) -> Record:
    """A record of parsed JSON.

    Parameters
    ----------
    kind
        A dataclass; its fields' types say what is allowed.
    document
        What ``json.loads`` gave.

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
