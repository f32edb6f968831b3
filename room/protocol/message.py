"""Writes and reads the state of one person: 85 bytes, or 113 with hands, thirty times a second.

Little endian, without gaps (DESIGN.md, "The room")::

    at  type      what                         one step
     0  u8        version, 1
     1  u8        flags, `Flag`
     2  u16       sequence, wraps
     4  u32       time of the sender's clock   1 ms, wraps
     8  u8  [52]  weights                      1/255
    60  i16 [3]   head position                1 mm
    66  i16 [4]   head rotation, x y z w       1/32767
    74  i8  [4]   gaze                         half a degree
    78  i16 [2]   body position, x z           1 cm
    82  i16       heading                      pi/32768, wraps
    84  u8        animation, `Animation`
                  and where flags say `Flag.HANDS`, the left hand, then the right one:
    85  i16 [3]   wrist's position                1 mm
    91  i16 [4]   hand's rotation, x y z w        1/32767
    99            the right hand, as the left one

Frames are glTF's: metres, right-handed, y up, x to the person's left, z out of the face; angles turn to the left and
upwards. The body stands in the room's frame. Head position and rotation are in the body's frame: how far the head is
from where it rests, so that zeros and (0, 0, 0, 1) are a head at rest on a body of any height. Hands are in the body's
frame as well, from the point of the floor where it stands: a hand on a table is on that table for all. A hand's z axis
lies along its fingers and y comes out of its back, so that (0, 0, 0, 1) is either hand held out flat. A hand that is
not seen is 14 zeros; both are never.

Hands came later, without another version: `Flag.HANDS` was kept for them, and nothing of ours had set it.
"""

import math
import struct
from dataclasses import dataclass
from enum import IntEnum, IntFlag

from facegen.conventions import BLENDSHAPES
from room.errors import FormatError
from room.protocol.hands import HANDS_BYTES, NUMBERS, Hand, check_hands, decode_hand, encode_hand, split
from room.protocol.steps import METRE_STEPS, UNIT_STEPS, check_unit, held, nearest

VERSION = 1

_LAYOUT = struct.Struct(f"<BBHI{len(BLENDSHAPES)}B3h4h4b2hhB")
MESSAGE_BYTES = _LAYOUT.size
"""Of a message without hands: 20.4 kbit/s at 30 a second."""
MOST_MESSAGE_BYTES = MESSAGE_BYTES + HANDS_BYTES
"""Of any message, with hands (6.7 kbit/s more); what is longer is refused before it is read."""

WEIGHT_STEPS = 255
GAZE_STEPS = 360 / math.pi
"""Half degrees to a radian; the i8 reaches 63.5 degrees, and an eye turns 55 at most."""
FLOOR_STEPS = 100
TURN_STEPS = 65536
"""Steps of a whole turn of the body."""


class Flag(IntFlag):
    """What is true of a person now."""

    SPEAKING = 1
    TRACKED = 2
    """A camera sees this face; without, it is moved by the voice alone and marked as such."""
    SEATED = 4
    HANDS = 8
    """A headset sees a hand or holds its controller: two hands stand behind the state."""


class Animation(IntEnum):
    """A gesture that the body makes; a receiver that does not know a number shows none."""

    NONE = 0
    WAVE = 1
    NOD = 2
    SHAKE = 3
    POINT = 4
    RAISE_HAND = 5
    CLAP = 6
    POINTER = 7
    """A dot that all see, where this person looks: heading and head's rotation together, from the eyes."""


@dataclass(frozen=True, kw_only=True)
class Message:
    """The state of one person.

    Parameters
    ----------
    flags
        `Flag`, as one number.
    sequence
        Counts messages of one sender; taken modulo 65,536.
    time_ms
        Of the sender's own clock, from any origin; taken modulo 2**32 (49.7 days).
    weights
        52, in the order of `facegen.conventions.BLENDSHAPES`; held to 0..1.
    head_m
        Displacement of the head from where it rests; body's frame, held to +-32.767 m.
    rotation
        Unit quaternion x, y, z, w of the head; body's frame.
    gaze
        Yaw and pitch of the left eye, then of the right eye, in radians from the head's z axis; held to +-63.5 degrees.
    floor_m
        x and z of the body in the room; held to +-327.67 m.
    heading
        Turn of the body about y in radians; 0 looks along the room's z. Comes back as -pi..pi.
    animation
        `Animation`, or a number that is not known yet.
    left_hand, right_hand
        x, y, z of the wrist in metres, held to +-32.767, and unit quaternion x, y, z, w; None where it is not seen.
        `Flag.HANDS` says that there is one at the least.
    """

    flags: int = 0
    sequence: int = 0
    time_ms: int = 0
    weights: tuple[float, ...] = (0.0,) * len(BLENDSHAPES)
    head_m: tuple[float, ...] = (0.0, 0.0, 0.0)
    rotation: tuple[float, ...] = (0.0, 0.0, 0.0, 1.0)
    gaze: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)
    floor_m: tuple[float, ...] = (0.0, 0.0)
    heading: float = 0.0
    animation: int = 0
    left_hand: Hand | None = None
    right_hand: Hand | None = None


_LENGTHS = {"weights": len(BLENDSHAPES), "head_m": 3, "rotation": 4, "gaze": 4, "floor_m": 2}


def encode(message: Message) -> bytes:
    """Make the bytes of a state.

    Raises
    ------
    FormatError
        If a tuple has another length, a number is NaN or infinite, a rotation is no unit quaternion, flags or
        animation do not fit, or `Flag.HANDS` and the hands disagree. What lies beyond a range is held to it.
    """
    hands = {name: getattr(message, name) for name in ("left_hand", "right_hand")}
    seen = {name: hand for name, hand in hands.items() if hand is not None}
    lengths = _LENGTHS | dict.fromkeys(seen, NUMBERS)
    for name, length in lengths.items():
        numbers = getattr(message, name)
        if len(numbers) != length:
            raise FormatError(f"{name}: has {len(numbers)} numbers, and must have {length}")
        if not all(map(math.isfinite, numbers)):
            raise FormatError(f"{name}: holds a number that is not finite; send the last good one, or rest")
    if not math.isfinite(message.heading):
        raise FormatError("heading: is not finite; send the last good one, or rest")
    check_unit("rotation", math.hypot(*message.rotation))
    for name, hand in seen.items():
        check_unit(name, math.hypot(*hand[3:]))
    if not 0 <= message.flags <= sum(Flag):
        raise FormatError(f"flags: is {message.flags}, and must be from 0 to {sum(Flag)}")
    if not 0 <= message.animation <= 255:
        raise FormatError(f"animation: is {message.animation}, and must be from 0 to 255")
    if bool(message.flags & Flag.HANDS) != bool(seen):
        raise FormatError(f"flags: say {message.flags & Flag.HANDS} of hands, and {len(seen)} are given")
    turn = nearest(math.fmod(message.heading, 2 * math.pi) / (2 * math.pi) * TURN_STEPS)
    state = _LAYOUT.pack(
        VERSION,
        message.flags,
        message.sequence % 2**16,
        message.time_ms % 2**32,
        *(held(weight, WEIGHT_STEPS, 0, 255) for weight in message.weights),
        *(held(metres, METRE_STEPS, -32767, 32767) for metres in message.head_m),
        *(held(part, UNIT_STEPS, -32767, 32767) for part in message.rotation),
        *(held(angle, GAZE_STEPS, -127, 127) for angle in message.gaze),
        *(held(metres, FLOOR_STEPS, -32767, 32767) for metres in message.floor_m),
        (turn + 32768) % TURN_STEPS - 32768,
        message.animation,
    )
    return state + b"".join(map(encode_hand, hands.values())) if seen else state


def decode(content: bytes) -> Message:
    """Read the bytes of a state.

    Raises
    ------
    FormatError
        If there are more or fewer bytes than its flags say, the version is another one, flags are unknown, a rotation
        is no unit quaternion, or hands are said and none is there.
    """
    check(content)
    _, flags, sequence, time_ms, *numbers, heading, animation = _LAYOUT.unpack_from(content)
    left, right = map(decode_hand, split(content[MESSAGE_BYTES:]))
    weights, head, rotation, gaze, floor = (
        tuple(numbers[start : start + length])
        for start, length in zip((0, 52, 55, 59, 63), _LENGTHS.values(), strict=True)
    )
    return Message(
        flags=flags,
        sequence=sequence,
        time_ms=time_ms,
        weights=tuple(step / WEIGHT_STEPS for step in weights),
        head_m=tuple(step / METRE_STEPS for step in head),
        rotation=tuple(step / UNIT_STEPS for step in rotation),
        gaze=tuple(step / GAZE_STEPS for step in gaze),
        floor_m=tuple(step / FLOOR_STEPS for step in floor),
        heading=heading * (2 * math.pi / TURN_STEPS),
        animation=animation,
        left_hand=left,
        right_hand=right,
    )


_ROTATION = struct.Struct("<4h")


def size(flags: int) -> int:
    """Bytes of a message with these flags."""
    return MOST_MESSAGE_BYTES if flags & Flag.HANDS else MESSAGE_BYTES


def check(content: bytes) -> None:
    """Refuse bytes that are no message of this version; what a server does for each, without reading the rest.

    Raises
    ------
    FormatError
        As in `decode`.
    """
    if not MESSAGE_BYTES <= len(content) <= MOST_MESSAGE_BYTES:
        raise FormatError(
            f"a state has {MESSAGE_BYTES} or {MOST_MESSAGE_BYTES} bytes, and this one has {len(content)}"
        )
    if content[0] != VERSION:
        raise FormatError(f"this room speaks version {VERSION} of the state, and this one is {content[0]}")
    if content[1] > sum(Flag):
        raise FormatError(f"flags: is {content[1]}, and must be from 0 to {sum(Flag)}")
    if len(content) != size(content[1]):
        raise FormatError(
            f"a state of these flags has {size(content[1])} bytes, and this one has {len(content)}"
        )
    check_unit("rotation", math.hypot(*_ROTATION.unpack_from(content, 66)) / UNIT_STEPS)
    if content[1] & Flag.HANDS:
        check_hands(content[MESSAGE_BYTES:])


_TIME = struct.Struct("<I")
_TIME_AT = 4


def time_of(content: bytes) -> int:
    """The sender's time in a message, without reading the rest; ms, of a message that was checked."""
    return _TIME.unpack_from(content, _TIME_AT)[0]


def retimed(content: bytes, time_ms: int) -> bytes:
    """The same message at another time of the sender's clock."""
    return content[:_TIME_AT] + _TIME.pack(time_ms % 2**32) + content[_TIME_AT + _TIME.size :]
