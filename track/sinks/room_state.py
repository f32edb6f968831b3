"""Writes a face as the state of one person in a room: 85 bytes, whose body stays as it rests.

`room` and its pages have the same layout (room/protocol/message.py); `track` imports nothing of them, and a test holds
these bytes against their vectors. Little endian::

    u8 1 | u8 flags | u16 sequence | u32 ms | 52 x u8 weights | 3 x i16 head, mm | 4 x i16 rotation, x y z w |
    4 x i8 gaze, half degrees | 2 x i16 body, cm | i16 heading | u8 animation
"""

import struct

import numpy as np

from track.sinks.axes import NO_TURN

TRACKED = 2
"""The flag of a face that a camera sees."""

_LAYOUT = struct.Struct("<BBHI52B3h4h4b2hhB")
_VERSION = 1
_WEIGHT_STEPS, _METRE_STEPS, _UNIT_STEPS, _GAZE_STEPS = 255, 1000, 32767, 360 / np.pi


def face_state(
    *,
    flags: int,
    sequence: int,
    time_ms: int,
    weights: np.ndarray,
    head_m: np.ndarray | None = None,
    rotation: np.ndarray | None = None,
    gaze: np.ndarray | None = None,
) -> bytes:
    """The bytes of one state; what lies beyond a range is held to it.

    Parameters
    ----------
    flags
        `TRACKED`, or 0.
    sequence, time_ms
        Count messages, and the sender's time; both wrap.
    weights : (52,) float
        In ARKit's order.
    head_m : (3,) float, optional
        How far the head is from where it rests, in glTF's frame.
    rotation : (4,) float, optional
        Unit quaternion of the head.
    gaze : (4,) float, optional
        As a sample has it.
    """
    still = np.zeros(4)
    return _LAYOUT.pack(
        _VERSION,
        flags,
        sequence % 2**16,
        time_ms % 2**32,
        *_steps(weights, _WEIGHT_STEPS, 0, 255),
        *_steps(still[:3] if head_m is None else head_m, _METRE_STEPS, -32767, 32767),
        *_steps(NO_TURN if rotation is None else rotation, _UNIT_STEPS, -32767, 32767),
        *_steps(still if gaze is None else gaze, _GAZE_STEPS, -127, 127),
        *(0, 0, 0, 0),
    )


def _steps(numbers: np.ndarray, steps: float, least: int, most: int) -> list[int]:
    """Whole steps, halves up, as in every other language of the protocol."""
    return np.floor(np.clip(np.asarray(numbers) * steps, least, most) + 0.5).astype(int).tolist()
