"""How often people come into a room: counted by a clock that the test moves, whatever else the machine does."""

from types import SimpleNamespace

import pytest

from room.errors import NotAllowed
from room.protocol.texts import Join
from room.server import join_limit
from room.server.join_limit import JoinLimit
from room.server.limits import BURST_S, NEWCOMERS_PER_S, RETURNS_PER_S
from room.state import identity

PEOPLE = 8
NEWCOMERS, RETURNS = 2 * PEOPLE, RETURNS_PER_S * BURST_S
"""That come in at one moment."""


class Clock:
    """A clock that stands still until it is told."""

    def __init__(self) -> None:
        self.now = 1000.0

    def monotonic(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    clock = Clock()
    monkeypatch.setattr(join_limit, "time", clock)
    return clock


def person(number: int, role: str = "page") -> Join:
    return Join(key="k" * 22, secret=f"{number:022}", name="Ada", role=role)


def meeting(*seated: Join) -> SimpleNamespace:
    """What is asked of a meeting: who has a place."""
    ids = {identity(join.secret) for join in seated}
    return SimpleNamespace(seat=lambda id: id if id in ids else None)


def come_in(limit: JoinLimit, joins: list[Join], place: SimpleNamespace, *, moderator: bool = False) -> int:
    """How many are let in."""
    refusals, count = [], 0
    for join in joins:
        try:
            limit.count(join, place, moderator=moderator)
            count += 1
        except NotAllowed as refused:
            refusals.append((str(refused), refused.again))
    assert set(refusals) <= {("too many come in at once; wait a moment", True)}
    return count


def test_new_people_have_a_burst_of_twice_the_places_and_then_a_rate(clock: Clock):
    limit, place = JoinLimit(PEOPLE), meeting()
    crowd = [person(number) for number in range(100)]
    assert come_in(limit, crowd, place) == NEWCOMERS
    for _ in range(3):
        clock.now += 1.0
        assert come_in(limit, crowd, place) == NEWCOMERS_PER_S
    clock.now += 3600.0
    assert come_in(limit, crowd, place) == NEWCOMERS


def test_one_who_comes_again_and_again_keeps_out_nobody_else(clock: Clock):
    storm, ada = person(1), person(2)
    limit, place = JoinLimit(PEOPLE), meeting(storm, ada)
    assert come_in(limit, [storm] * 100, place) == RETURNS
    clock.now += 2.0
    assert come_in(limit, [storm] * 100, place) == 2 * RETURNS_PER_S
    assert come_in(limit, [ada] * 100, place) == RETURNS
    assert come_in(limit, [person(number) for number in range(10, 100)], place) == NEWCOMERS


def test_who_has_left_is_counted_anew(clock: Clock):
    storm = person(1)
    limit, place = JoinLimit(PEOPLE), meeting(storm)
    come_in(limit, [storm] * 100, place)
    limit.forget(identity(storm.secret))
    assert come_in(limit, [storm] * 100, place) == RETURNS


def test_moderators_and_the_cameras_of_strangers_are_not_counted(clock: Clock):
    limit, place = JoinLimit(PEOPLE), meeting()
    crowd = [person(number) for number in range(100)]
    assert come_in(limit, crowd, place, moderator=True) == 100
    assert come_in(limit, [person(number, role="face") for number in range(100)], place) == 100
    assert come_in(limit, crowd, place) == NEWCOMERS
