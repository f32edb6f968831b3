"""Writes and reads the two hands that may stand behind a state (`room.protocol.message`): 14 bytes each.

A hand is x, y, z of the wrist in metres and a unit quaternion x, y, z, w. One that is not seen is None, and 14 zeros.
"""

import math
import struct

from room.errors import FormatError
from room.protocol.steps import METRE_STEPS, UNIT_STEPS, check_unit, held

NUMBERS = 7
Hand = tuple[float, ...]

_HAND = struct.Struct("<3h4h")
_ROTATION = struct.Struct("<4h")
_ROTATION_AT = 6
_NOT_SEEN = bytes(_HAND.size)
HANDS_BYTES = 2 * _HAND.size


def encode_hand(hand: Hand | None) -> bytes:
    """14 bytes of a hand that was checked."""
    if hand is None:
        return _NOT_SEEN
    return _HAND.pack(
        *(held(metres, METRE_STEPS, -32767, 32767) for metres in hand[:3]),
        *(held(part, UNIT_STEPS, -32767, 32767) for part in hand[3:]),
    )


def decode_hand(content: bytes) -> Hand | None:
    """A hand of 14 bytes that were checked; None of none."""
    if not any(content):
        return None
    steps = _HAND.unpack(content)
    return (*(step / METRE_STEPS for step in steps[:3]), *(step / UNIT_STEPS for step in steps[3:]))


def split(content: bytes) -> tuple[bytes, bytes]:
    """The left hand's bytes and the right one's; empty where there are none."""
    return content[: _HAND.size], content[_HAND.size :]


def check_hands(content: bytes) -> None:
    """Refuse two hands neither of which is seen, and rotations that are none.

    Raises
    ------
    FormatError
        If so.
    """
    seen = [hand for hand in split(content) if any(hand)]
    if not seen:
        raise FormatError("flags: say that a hand is seen, and none is there")
    for hand in seen:
        check_unit("hand", math.hypot(*_ROTATION.unpack_from(hand, _ROTATION_AT)) / UNIT_STEPS)
