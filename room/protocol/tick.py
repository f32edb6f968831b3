"""Packs what a room sends to all, once a tick: what came since the last one, each behind the person's number.

Little endian::

    at  type  what
     0  u8    version, 1
     1  u8    kind, 1
     2  u16   number of states
     4  u32   time of the server's clock, 1 ms, wraps
     8        for each: u16 number of the person (the roster says who), and a `room.protocol.message`,
           whose flags say how long it is

A person may stand in it more than once, oldest first: two messages of one tick are both passed on.
"""

import struct
from collections.abc import Sequence

from room.errors import FormatError
from room.protocol.message import MESSAGE_BYTES, VERSION, check, size

KIND = 1
_HEAD = struct.Struct("<BBHI")
_NUMBER = struct.Struct("<H")
HEAD_BYTES = _HEAD.size
ENTRY_BYTES = _NUMBER.size + MESSAGE_BYTES
"""Of a state without hands; the least that stands for a person."""


def pack(states: Sequence[tuple[int, bytes]], *, time_ms: int) -> bytes:
    """One buffer for all.

    Parameters
    ----------
    states
        The person's number, and a message that was checked.
    time_ms
        Of the server's clock; taken modulo 2**32.
    """
    parts = [_HEAD.pack(VERSION, KIND, len(states), time_ms % 2**32)]
    for number, state in states:
        parts += (_NUMBER.pack(number), state)
    return b"".join(parts)


def unpack(content: bytes) -> tuple[int, list[tuple[int, bytes]]]:
    """Time of the server in ms, and the messages behind the person's number.

    Raises
    ------
    FormatError
        If the length does not fit the count, version or kind are others, or a message is refused.
    """
    if len(content) < HEAD_BYTES:
        raise FormatError(f"a tick has at least {HEAD_BYTES} bytes, and this one has {len(content)}")
    version, kind, count, time_ms = _HEAD.unpack_from(content)
    if (version, kind) != (VERSION, KIND):
        raise FormatError(
            f"a tick of version {VERSION} and kind {KIND} is expected, and this is {version}, {kind}"
        )
    states, at = [], HEAD_BYTES
    for _ in range(count):
        if len(content) < at + ENTRY_BYTES:
            raise FormatError(f"a tick of {count} states ends behind {len(states)}")
        start = at + _NUMBER.size
        at = start + size(content[start + 1])
        state = content[start:at]
        check(state)
        states.append((_NUMBER.unpack_from(content, start - _NUMBER.size)[0], state))
    if at != len(content):
        raise FormatError(f"a tick of {count} states has {at} bytes, and this one has {len(content)}")
    return time_ms, states
