"""Whom pages colour how: the first people of a room differ, and each has one colour wherever and whenever they come."""

import re
from pathlib import Path

from room.protocol.texts import Join
from room.state import Meeting, identity
from room.state.numbers import COLOURS

PAGE = Path(__file__).resolve().parents[2] / "web/room/figure/colours.ts"
SECRETS = [f"{number:022}" for number in range(40)]


def _enter(meeting: Meeting, secret: str) -> int:
    return meeting.enter(Join(key="k" * 22, secret=secret, name="Who"), moderator=False).number


def test_a_page_has_as_many_colours_as_the_room_counts():
    (clothes,) = re.findall(r"export const CLOTHES = \[(.*?)\]", PAGE.read_text(), re.DOTALL)
    assert len(set(re.findall(r"0x[0-9a-f]{6}", clothes))) == COLOURS


def test_the_first_twelve_have_colours_of_their_own_and_the_others_numbers():
    meeting = Meeting(most_people=64)
    numbers = [_enter(meeting, secret) for secret in SECRETS]
    assert len({number % COLOURS for number in numbers[:COLOURS]}) == COLOURS
    assert len(set(numbers)) == len(numbers)


def test_somebody_has_one_colour_at_every_process_and_whenever_they_come():
    for secret in SECRETS:
        meetings = [Meeting(most_people=8, first_number=first) for first in (0, 0, 1, 17, 0xFFF0)]
        _enter(meetings[1], next(each for each in SECRETS if _wish(each) != _wish(secret)))
        assert {_enter(meeting, secret) % COLOURS for meeting in meetings} == {_wish(secret)}


def test_who_leaves_gives_the_colour_to_the_next():
    meeting = Meeting(most_people=64)
    numbers = [_enter(meeting, secret) for secret in SECRETS[:COLOURS]]
    meeting.leave(meeting.seat(identity(SECRETS[4])))
    assert _enter(meeting, SECRETS[20]) == numbers[4]


def _wish(secret: str) -> int:
    return int(identity(secret), 16) % COLOURS
