"""Says in one sentence which values of a record pydantic refused, and what is allowed there."""

import dataclasses
import difflib
import json
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, get_args, get_origin, get_type_hints

if TYPE_CHECKING:
    from pydantic import ValidationError

MOST_ENTRIES = 3
"""Refused values that are named one by one; a union's branches and a list's items can refuse by the hundred."""

MOST_CHARACTERS = 60
"""A value whose JSON is longer is not repeated."""

_UNKNOWN = ("unexpected_keyword_argument", "extra_forbidden")
"""Pydantic's words for a key that is no field."""

Place = tuple[str | int, ...]
"""Keys and indices from the outermost record down to a value."""


def refusal(error: "ValidationError", record: type) -> str:
    """Describe refused values: each one's path, the value, and what is allowed or which keys are known.

    Parameters
    ----------
    error
        What pydantic raised.
    record
        The class that was asked for, a pydantic dataclass or model; unknown keys are held against its fields.
    """
    # a mistyped key is why another one is missing, and must not be among those that are only counted
    entries = sorted(error.errors(include_url=False), key=lambda entry: entry["type"] not in _UNKNOWN)
    sentences = [_sentence(entry, record) for entry in entries[:MOST_ENTRIES]]
    if len(entries) > MOST_ENTRIES:
        sentences.append(f"and {len(entries) - MOST_ENTRIES} more")
    return "; ".join(sentences)


def _sentence(entry: dict[str, Any], record: type) -> str:
    kind = entry["type"]
    # pydantic's word for a key of a mapping itself
    place = tuple(key for key in entry["loc"] if key != "[key]")
    path = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in place).lstrip(".")
    if kind in _UNKNOWN:
        known = _known_keys(place, record)
        close = difflib.get_close_matches(str(place[-1]), known, n=1)
        hint = f"did you mean {close[0]!r}? " if close else ""
        return f"unknown key {path!r}; {hint}Known keys here: {', '.join(known)}"
    if kind in ("missing", "missing_argument", "missing_keyword_only_argument"):
        return f"key {path!r} is missing"
    message = re.sub(r"^(Input|\w+) should", "must", entry["msg"].removeprefix("Value error, "))
    message = message.replace("must be a valid integer", "must be a whole number")
    message = message.replace("must be a valid", "must be a").replace("must be an object", "must be a table")
    message = re.sub(r"must be a dictionary or an instance of \w+", "must be a table", message)
    message = message.replace(" after validation", "")  # which says nothing to who wrote the file
    value = _as_text(entry["input"])
    if not path:
        return message
    return f"{path} = {value}: {message}" if value else f"{path}: {message}"


def _as_text(value: object) -> str:
    """JSON of a value; empty where it is long, or no value of a file."""
    try:
        text = json.dumps(value)
    except (TypeError, ValueError):
        return ""
    return text if len(text) <= MOST_CHARACTERS else ""


def _known_keys(place: Place, record: type) -> list[str]:
    """Fields of the record in which the last key of ``place`` stands; none where that is no record."""
    key_of_mapping = False
    for key in place[:-1]:
        if isinstance(key, int) or key_of_mapping:
            key_of_mapping = False
            continue
        annotation = _fields(record).get(key)
        inner = [kind for kind in _records_in(annotation) if _fields(kind)]
        if not inner:
            return []
        record, key_of_mapping = inner[0], get_origin(annotation) is dict
    return list(_fields(record))


def _fields(record: type) -> dict[str, Any]:
    """Types of a pydantic dataclass's or model's fields, by name."""
    if isinstance(record, type) and dataclasses.is_dataclass(record):
        types = get_type_hints(record)
        return {field.name: types[field.name] for field in dataclasses.fields(record)}
    return {name: field.annotation for name, field in getattr(record, "model_fields", {}).items()}


def _records_in(annotation: object) -> Iterator[Any]:
    """An annotation and all in it, as in ``tuple[Led, ...] | None``."""
    yield annotation
    for inner in get_args(annotation):
        yield from _records_in(inner)
