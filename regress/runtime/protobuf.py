"""Reads and writes the wire format of protobuf, four lines of its documentation
(https://protobuf.dev/programming-guides/encoding)."""

from collections.abc import Iterator
from dataclasses import dataclass

_BYTES = {1: 8, 5: 4}
"""Of the kinds that have a fixed length."""

_VARINT, _LENGTH = 0, 2
"""Kinds of fields: a number, and bytes behind their length."""


@dataclass(frozen=True, eq=False)
class Field:
    """One field of a message.

    Parameters
    ----------
    number
        By which the message's definition names it.
    value
        A number, or the bytes that it holds.
    raw
        Its bytes in the message, key and length among them.
    """

    number: int
    value: memoryview | int
    raw: memoryview


def fields(message: memoryview) -> Iterator[Field]:
    """The fields of a message, in order.

    Raises
    ------
    ValueError, IndexError
        Where it is none, or is cut.
    """
    place = 0
    while place < len(message):
        start = place
        key, place = _varint(message, place)
        kind = key & 7
        value: memoryview | int
        if kind == _VARINT:
            value, place = _varint(message, place)
        else:
            if kind == _LENGTH:
                size, place = _varint(message, place)
            elif kind in _BYTES:
                size = _BYTES[kind]
            else:
                raise ValueError(f"a field of kind {kind}")
            value, place = message[place : place + size], place + size
            if place > len(message):
                raise ValueError("a field ends behind its message")
        yield Field(key >> 3, value, message[start:place])


def number_field(number: int, value: int) -> bytes:
    """A field that holds a number."""
    return _digits(number << 3 | _VARINT) + _digits(value)


def bytes_field(number: int, value: bytes | memoryview) -> bytes:
    """A field that holds bytes: a text, or another message."""
    return _digits(number << 3 | _LENGTH) + _digits(len(value)) + bytes(value)


def _varint(message: memoryview, place: int) -> tuple[int, int]:
    """A number of seven bits a byte, least first, and the place behind it."""
    value = 0
    for shift in range(0, 70, 7):
        byte = message[place]
        place += 1
        value |= (byte & 0x7F) << shift
        if byte < 0x80:
            return value, place
    raise ValueError("a number of more than ten bytes")


def _digits(value: int) -> bytes:
    """What `_varint` reads."""
    digits = bytearray()
    while value >= 0x80:
        digits.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*digits, value])
