"""Makes the test vectors that every language's reader and writer of the wire message is held to.

``room/protocol/vectors.json`` has four lists: ``states`` (a state, its bytes, and what they read back as),
``refused_states`` (fields that must not be encoded), ``refused_messages`` (bytes that must not be decoded) and
``ticks``. JSON knows no NaN: ``"nan"``, ``"inf"`` and ``"-inf"`` stand for themselves.
"""

import json
import math
from dataclasses import asdict, replace

from facegen.conventions import BLENDSHAPES
from room.protocol.message import GAZE_STEPS, Animation, Message, decode, encode
from room.protocol.steps import UNIT_STEPS
from room.protocol.tick import pack

_HALF = math.sqrt(0.5)
_TURNED = (0.1, 0.2, -0.3, math.sqrt(1 - 0.14))
_COUNT = len(BLENDSHAPES)


def _states() -> dict[str, Message]:
    rest = Message()
    return {
        "rest": rest,
        "everything": Message(
            flags=15,
            left_hand=(0.3, 1.1, 0.45, *_TURNED),
            right_hand=(-0.25, 1.4, 0.5, 0.0, _HALF, 0.0, -_HALF),
            sequence=4660,
            time_ms=305419896,
            weights=tuple(index / (_COUNT - 1) for index in range(_COUNT)),
            head_m=(0.0123, -0.0456, 0.0789),
            rotation=_TURNED,
            gaze=(0.1, -0.2, 0.3, -0.4),
            floor_m=(-1.234, 5.678),
            heading=-2.5,
            animation=6,
        ),
        "all at their most": Message(
            flags=15,
            left_hand=(32.767,) * 3 + (1.0, 0.0, 0.0, 0.0),
            right_hand=(32.767,) * 3 + (0.0, 0.0, 0.0, 1.0),
            sequence=65535,
            time_ms=2**32 - 1,
            weights=(1.0,) * _COUNT,
            head_m=(32.767,) * 3,
            rotation=(1.0, 0.0, 0.0, 0.0),
            gaze=(127 / GAZE_STEPS,) * 4,
            floor_m=(327.67,) * 2,
            heading=math.pi * 32767 / 32768,
            animation=255,
        ),
        "all at their least": replace(
            rest,
            head_m=(-32.767,) * 3,
            rotation=(0.0, 0.0, 0.0, -1.0),
            gaze=(-127 / GAZE_STEPS,) * 4,
            floor_m=(-327.67,) * 2,
            heading=-math.pi,
        ),
        "beyond every range": replace(
            rest,
            weights=(-0.1, 1.6, 1e300, -1e300) + (0.5,) * (_COUNT - 4),
            head_m=(1e9, -1e9, 32.7675),
            rotation=(0.0, 1.004, 0.0, 0.0),
            gaze=(math.pi, -math.pi, 1.2, -1.2),
            floor_m=(1e300, -1e300),
        ),
        "a left hand alone": replace(rest, flags=8, left_hand=(0.2, 1.2345, 0.4, *_TURNED)),
        "a right hand alone, where its person stands": replace(
            rest, flags=10, right_hand=(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0)
        ),
        "hands at their least and beyond": replace(
            rest,
            flags=8,
            left_hand=(-32.767,) * 3 + (-1.0, 0.0, 0.0, 0.0),
            right_hand=(1e300, -1e300, -0.0005, 0.0, 1.004, 0.0, 0.0),
        ),
        "counters wrap": replace(rest, sequence=65536, time_ms=2**32 + 7),
        "heading wraps": replace(rest, heading=math.pi),
        "heading of many turns": replace(rest, heading=-100.0),
        "weights below, at and above half a step": replace(
            rest,
            weights=tuple((index // 3 + (0.49, 0.5, 0.51)[index % 3]) / 255 for index in range(_COUNT)),
        ),
        "negative halves go up": replace(
            rest,
            head_m=(-0.0005, -0.0015, 0.0005),
            floor_m=(-0.005, 0.005),
            rotation=(0.0, 0.0, _HALF, _HALF),
        ),
        "points at a screen while seated": replace(
            rest,
            flags=6,
            rotation=(-math.sin(0.05), 0.0, 0.0, math.cos(0.05)),
            floor_m=(0.05, 0.78),
            heading=3.1,
            animation=Animation.POINTER,
        ),
        "gaze by quarter degrees": replace(
            rest, gaze=tuple(math.radians(degrees) for degrees in (0.24, 0.26, -0.24, -0.26))
        ),
    }


_REFUSED_STATES = {
    "a weight that is no number": {"weights": ["nan"] + [0] * (_COUNT - 1)},
    "51 weights": {"weights": [0] * (_COUNT - 1)},
    "53 weights": {"weights": [0] * (_COUNT + 1)},
    "a head that is no number": {"head_m": [0, "nan", 0]},
    "a head at infinity": {"head_m": [0, 0, "inf"]},
    "a rotation that is no number": {"rotation": [0, 0, 0, "nan"]},
    "no rotation at all": {"rotation": [0, 0, 0, 0]},
    "a rotation of length 1.02": {"rotation": [0, 0, 0, 1.02]},
    "gaze that is no number": {"gaze": ["nan", 0, 0, 0]},
    "gaze of one eye": {"gaze": [0, 0]},
    "a place at minus infinity": {"floor_m": ["-inf", 0]},
    "a heading that is no number": {"heading": "nan"},
    "an unknown flag": {"flags": 16},
    "hands that are said, and none": {"flags": 8},
    "a hand that is not said": {"left_hand": [0, 1, 0, 0, 0, 0, 1]},
    "a hand without a rotation": {"flags": 8, "left_hand": [0, 1, 0]},
    "a hand that is no number": {"flags": 8, "right_hand": [0, "nan", 0, 0, 0, 0, 1]},
    "a hand at infinity": {"flags": 8, "right_hand": ["inf", 0, 0, 0, 0, 0, 1]},
    "a hand that is turned by nothing": {"flags": 8, "left_hand": [0, 1, 0, 0, 0, 0, 0]},
    "a hand whose rotation is too long": {"flags": 8, "right_hand": [0, 1, 0, 0, 0, 0, 1.02]},
    "a negative animation": {"animation": -1},
    "an animation beyond a byte": {"animation": 256},
}


_HELD_OUT = (0.0, 1.2, 0.4, 0.0, 0.0, 0.0, 1.0)


def _refused_messages() -> dict[str, bytes]:
    rest = encode(Message())
    both = encode(Message(flags=8, left_hand=_HELD_OUT, right_hand=_HELD_OUT))
    return {
        "nothing": b"",
        "a byte too few": rest[:-1],
        "a byte too many": rest + b"\0",
        "version 0": b"\0" + rest[1:],
        "version 2": b"\2" + rest[1:],
        "an unknown flag": rest[:1] + b"\x10" + rest[2:],
        "a rotation of zeros": rest[:66] + bytes(8) + rest[74:],
        "a rotation that is too long": rest[:66] + b"\xff\x7f" * 4 + rest[74:],
        "hands that are said, and the state ends": b"\1\x08" + rest[2:],
        "hands that nobody said": b"\1\0" + both[2:],
        "hands that are said, and neither is seen": both[:85] + bytes(28),
        "one hand of two": both[:-14],
        "a byte behind the hands": both + b"\0",
        "a hand that is turned by nothing": both[:91] + bytes(8) + both[99:],
        "a right hand whose rotation is too long": both[:-8] + b"\xff\x7f" * 4,
    }


def _ticks() -> dict[str, tuple[int, list[tuple[int, Message]]]]:
    states = _states()
    return {
        "nobody": (0, []),
        "one": (5, [(1, states["rest"])]),
        "one person twice": (6, [(1, states["everything"]), (1, states["rest"])]),
        "hands between others": (
            7,
            [
                (1, states["rest"]),
                (2, states["a left hand alone"]),
                (3, states["everything"]),
                (4, states["rest"]),
            ],
        ),
        "two": (2**32 - 1, [(65535, states["everything"]), (2, states["all at their least"])]),
    }


def text() -> str:
    """The whole file."""
    ticks = {
        name: (time_ms, [(number, encode(message)) for number, message in people])
        for name, (time_ms, people) in _ticks().items()
    }
    document = {
        "steps": {"weights": 1 / 255, "head_m": 0.001, "rotation": 1 / UNIT_STEPS, "gaze": 1 / GAZE_STEPS},
        "states": [
            {
                "name": name,
                "state": asdict(state),
                "hex": encode(state).hex(),
                "read": asdict(decode(encode(state))),
            }
            for name, state in _states().items()
        ],
        "refused_states": [{"name": name, "state": state} for name, state in _REFUSED_STATES.items()],
        "refused_messages": [
            {"name": name, "hex": hexed.hex()} for name, hexed in _refused_messages().items()
        ],
        "ticks": [
            {
                "name": name,
                "time_ms": time_ms,
                "states": [[number, state.hex()] for number, state in people],
                "hex": pack(people, time_ms=time_ms).hex(),
            }
            for name, (time_ms, people) in ticks.items()
        ],
    }
    return json.dumps(document, indent=1) + "\n"
