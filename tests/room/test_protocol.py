"""The wire message: the vectors as they are committed, round trips within half a step, and all that is refused."""

import json
import math
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import room.protocol.vectors
from room.errors import FormatError
from room.protocol import MESSAGE_BYTES, Flag, Message, check, decode, encode
from room.protocol.message import FLOOR_STEPS, GAZE_STEPS, MOST_MESSAGE_BYTES, TURN_STEPS, WEIGHT_STEPS
from room.protocol.steps import METRE_STEPS, UNIT_STEPS
from room.protocol.tick import pack, unpack
from room.server.live_room import HERTZ

FILE = Path(room.protocol.vectors.__file__).with_name("vectors.json")
VECTORS = json.loads(FILE.read_text(encoding="utf-8"))
WEBSOCKET_BYTES = 4
"""Before up to 64 kB from a server."""
ROUNDING = 1e-9
"""What floats lose beside the half step: the largest number, 327.67, has an ulp of 6e-14."""


def _named(entries: list[dict]) -> list:
    return [pytest.param(entry, id=entry["name"]) for entry in entries]


def _numbers(fields: dict) -> dict:
    def number(value):
        return float(value) if isinstance(value, str) else value

    return {
        name: tuple(map(number, value)) if isinstance(value, list) else number(value)
        for name, value in fields.items()
    }


def test_the_file_is_what_the_command_prints():
    assert FILE.read_text(encoding="utf-8") == room.protocol.vectors.text(), (
        "run `room vectors > room/protocol/vectors.json`, and read the difference"
    )


@pytest.mark.parametrize("vector", _named(VECTORS["states"]))
def test_a_state_has_these_bytes_and_reads_back(vector):
    content = bytes.fromhex(vector["hex"])
    assert encode(Message(**_numbers(vector["state"]))) == content
    assert decode(content) == Message(**_numbers(vector["read"]))
    assert len(content) == (MOST_MESSAGE_BYTES if content[1] & 8 else MESSAGE_BYTES)
    assert (MESSAGE_BYTES, MOST_MESSAGE_BYTES) == (85, 113)


@pytest.mark.parametrize("vector", _named(VECTORS["refused_states"]))
def test_a_state_is_refused_before_it_is_sent(vector):
    with pytest.raises(FormatError):
        encode(replace(Message(), **_numbers(vector["state"])))


@pytest.mark.parametrize("vector", _named(VECTORS["refused_messages"]))
def test_bytes_are_refused(vector):
    with pytest.raises(FormatError):
        decode(bytes.fromhex(vector["hex"]))


@pytest.mark.parametrize("vector", _named(VECTORS["ticks"]))
def test_a_tick_packs_and_unpacks(vector):
    states = [(number, bytes.fromhex(content)) for number, content in vector["states"]]
    content = bytes.fromhex(vector["hex"])
    assert pack(states, time_ms=vector["time_ms"]) == content
    assert unpack(content) == (vector["time_ms"], states)
    for damaged in (content[:-1], content + b"\0", b"\0" + content[1:], content[:1] + b"\0" + content[2:]):
        with pytest.raises(FormatError):
            unpack(damaged)


@pytest.mark.parametrize("people", [1, 8, 64, 200])
def test_a_person_seen_costs_at_most_25_kbit_a_second(people):
    """Of those without a headset, whose hands cost 6.7 more; the head that WebSocket puts before a tick counts too."""
    tick = pack([(number, encode(Message())) for number in range(people)], time_ms=0)
    assert (len(tick) + WEBSOCKET_BYTES) * 8 * HERTZ / people <= 25_000


def floats(most: float, count: int) -> st.SearchStrategy[tuple[float, ...]]:
    return st.tuples(*[st.floats(-most, most)] * count)


def _unit(parts: tuple[float, ...]) -> tuple[float, ...]:
    length = math.hypot(*parts)
    return tuple(part / length for part in parts)


quaternions = floats(1, 4).filter(lambda parts: math.hypot(*parts) > 1e-3).map(_unit)
hands = st.none() | st.builds(lambda at, turned: at + turned, floats(32.767, 3), quaternions)


def _with_hands(message: Message, left: tuple | None, right: tuple | None) -> Message:
    said = Flag.HANDS if left or right else 0
    return replace(message, flags=message.flags | said, left_hand=left, right_hand=right)


states = st.builds(
    Message,
    flags=st.integers(0, 7),
    sequence=st.integers(0, 2**16 - 1),
    time_ms=st.integers(0, 2**32 - 1),
    weights=st.tuples(*[st.floats(0, 1)] * 52),
    head_m=floats(32.767, 3),
    rotation=quaternions,
    gaze=floats(127 / GAZE_STEPS, 4),
    floor_m=floats(327.67, 2),
    heading=st.floats(-math.pi, math.pi),
    animation=st.integers(0, 255),
)
messages = st.builds(_with_hands, states, hands, hands)
STEPS = {
    "weights": WEIGHT_STEPS,
    "head_m": METRE_STEPS,
    "rotation": UNIT_STEPS,
    "gaze": GAZE_STEPS,
    "floor_m": FLOOR_STEPS,
}


@given(messages)
def test_a_round_trip_loses_half_a_step_at_most(message):
    back = decode(encode(message))
    for name, steps in STEPS.items():
        for sent, read in zip(getattr(message, name), getattr(back, name), strict=True):
            assert abs(sent - read) <= 0.5 / steps + ROUNDING, name
    for name in ("left_hand", "right_hand"):
        hand, read = getattr(message, name), getattr(back, name)
        assert (hand is None) == (read is None)
        for index, (sent, came) in enumerate(zip(hand or (), read or (), strict=True)):
            assert abs(sent - came) <= 0.5 / (METRE_STEPS if index < 3 else UNIT_STEPS) + ROUNDING, name
    turned = math.remainder(message.heading - back.heading, 2 * math.pi)
    assert abs(turned) <= math.pi / TURN_STEPS + ROUNDING
    for name in ("flags", "sequence", "time_ms", "animation"):
        assert getattr(message, name) == getattr(back, name)
    assert encode(back) == encode(message), "what was read once is sent on unchanged"


def _bytes(length: int) -> st.SearchStrategy[bytes]:
    return st.binary(min_size=length, max_size=length)


HANDS_SAID = st.builds(
    lambda state, hands: state[:1] + bytes((state[1] | 8,)) + state[2:] + hands,
    messages.map(encode),
    _bytes(28),
)
"""A good state that says hands, and any bytes as those."""


@given(
    st.binary(max_size=2 * MESSAGE_BYTES) | _bytes(MESSAGE_BYTES) | _bytes(MOST_MESSAGE_BYTES) | HANDS_SAID
)
def test_any_bytes_are_read_or_refused_by_a_sentence(content):
    try:
        check(content)
    except FormatError:
        with pytest.raises(FormatError):
            decode(content)
    else:
        decode(content)


@given(
    st.lists(st.tuples(st.integers(0, 2**16 - 1), messages.map(encode)), max_size=4), st.integers(0, 2**40)
)
def test_a_tick_comes_back(states, time_ms):
    assert unpack(pack(states, time_ms=time_ms)) == (time_ms % 2**32, states)
