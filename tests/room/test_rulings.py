"""What moderators have decided of people holds for those who leave and come back, and takes no more than its room."""

import asyncio
import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from room.errors import NotAllowed
from room.protocol.answers import Door
from room.protocol.texts import MOST_NAME_CHARACTERS, Join, Moderate
from room.state import Meeting, Seat, identity
from room.state.kept_rulings import KEPT_S, MOST_KEPT, KeptRulings
from room.state.meeting import KEEP_S, MOST_BEYOND
from room.state.rulings import MOST_RULED, Rulings
from tests.room.guests import meeting

SECRET = "a" * 22


def _meeting() -> tuple[Meeting, Seat, Seat]:
    meeting = Meeting(most_people=8)
    chair = meeting.enter(Join(key="k" * 22, secret="c" * 22, name="Chair"), moderator=True)
    return meeting, chair, _enter(meeting)


def _enter(meeting: Meeting) -> Seat:
    return meeting.enter(Join(key="k" * 22, secret=SECRET, name="Ada"), moderator=False)


@pytest.mark.parametrize("goes", ["by leaving", "by staying away"])
def test_who_goes_and_comes_back_is_muted_and_undressed_as_before(goes):
    meeting, chair, ada = _meeting()
    for action in ("mute", "undress"):
        meeting.moderate(chair, Moderate(action=action, number=ada.number))
    if goes == "by leaving":
        meeting.leave(ada)
    else:
        ada.gone_at = 0.0
        assert meeting.expire(now=KEEP_S + 1) == [ada]
    again = _enter(meeting)
    assert again is not ada
    assert again.person.muted
    assert meeting.rulings.is_undressed(again.id)
    meeting.moderate(chair, Moderate(action="unmute", number=again.number))
    meeting.leave(again)
    assert not _enter(meeting).person.muted


@pytest.mark.parametrize("action", ["mute", "undress", "unshare", "remove"])
def test_an_act_hits_nobody_who_got_the_number_meanwhile(action):
    meeting, chair, ada = _meeting()
    meeting.leave(ada)
    ben = meeting.settle(None, ada.number, "b" * 16)
    before = ben.person
    for number in (ada.number, chair.number):
        with pytest.raises(NotAllowed, match="nothing was done"):
            meeting.moderate(chair, Moderate(action=action, number=number, id=ada.id))
    assert meeting.seat(ben.id) is ben
    assert ben.person == before
    assert not meeting.rulings.any
    assert meeting.moderate(chair, Moderate(action=action, number=ben.number, id=ben.id)) is ben


@given(
    st.lists(
        st.tuples(
            st.integers(0, 5),
            st.sampled_from(["Ada", "ADA", "\uff21da", "Ada 2", "a" * 40]),
            st.booleans(),
            st.booleans(),
        ),
        max_size=20,
    )
)
def test_no_two_people_have_one_name(coming):
    meeting = Meeting(most_people=8)
    for person, name, moderator, goes in coming:
        moderators = [
            each for each in meeting.seats if each.moderator and each.id != identity(str(person) * 22)
        ]
        kept = [each.name for each in moderators]
        seat = meeting.enter(Join(key="k" * 22, secret=str(person) * 22, name=name), moderator=moderator)
        assert [each.name for each in moderators] == kept
        seat.gone_at = 0.0 if goes else None
        assert seat.name[:2] == name[:2]
        names = [unicodedata.normalize("NFKC", each.name).casefold() for each in meeting.seats]
        assert len({*names}) == len(names)
        assert max(map(len, names)) <= MOST_NAME_CHARACTERS
    for seat in meeting.seats:
        meeting.leave(seat)
    alone = meeting.enter(Join(key="k" * 22, secret=SECRET, name="Ada"), moderator=False)
    assert alone.name == "Ada"


def _come(meeting: Meeting, number: int, *, moderator: bool = False) -> Seat:
    return meeting.enter(Join(key="k" * 22, secret=f"{number:022}", name="Ada"), moderator=moderator)


def test_a_moderator_has_their_name_whoever_came_before():
    meeting = Meeting(most_people=8)
    guest = _come(meeting, 1)
    chair = _come(meeting, 2, moderator=True)
    assert (chair.name, guest.name) == ("Ada", "Ada 2")
    chair.gone_at = 0.0
    assert _come(meeting, 3).name == "Ada 3", "a moderator's name is kept while they are away"
    assert _come(meeting, 4, moderator=True).name == "Ada 4"
    assert guest.name == "Ada 2"


def test_who_has_gone_keeps_no_name_from_who_comes():
    meeting = Meeting(most_people=8)
    gone = _come(meeting, 1)
    assert _come(meeting, 2).name == "Ada 2"
    gone.gone_at = 0.0
    assert _come(meeting, 3).name == "Ada"
    assert _come(meeting, 1).name == gone.name == "Ada 3"


def test_moderators_come_into_a_full_room_and_not_without_end():
    def come(number: int, *, moderator: bool) -> Seat:
        secret = f"{number:022}"
        return meeting.enter(Join(key="k" * 22, secret=secret, name="Ada"), moderator=moderator)

    meeting = Meeting(most_people=3)
    for number in range(3):
        come(number, moderator=False)
    beyond = [come(10 + number, moderator=True) for number in range(MOST_BEYOND)]
    for moderator in (False, True):
        with pytest.raises(NotAllowed, match="is full"):
            come(100, moderator=moderator)
    meeting.moderate(beyond[0], Moderate(action="remove", number=beyond[1].number))
    with pytest.raises(NotAllowed, match="is full"):
        come(100, moderator=False)
    come(100, moderator=True)


def test_of_too_many_rulings_the_oldest_are_forgotten():
    rulings = Rulings()
    for number in range(MOST_RULED + 1):
        for rule in (rulings.remove, rulings.undress, lambda id: rulings.mute(id, True)):
            assert rule(str(number))
    assert len(rulings.removed) == len(rulings.undressed) == len(rulings.mutes) == MOST_RULED
    for is_ruled in (rulings.is_removed, rulings.is_undressed, rulings.is_muted):
        assert (is_ruled("0"), is_ruled("1")) == (False, True)


def test_of_mutes_the_later_act_counts_and_what_is_known_is_not_new():
    rulings = Rulings()
    assert rulings.mute("a", True, acts=3)
    assert not rulings.mute("a", False, acts=2)
    assert not rulings.mute("a", True, acts=3)
    assert rulings.is_muted("a")
    assert rulings.mute("a", False)
    assert rulings.mutes["a"] == (4, False)
    assert rulings.remove("a")
    assert not rulings.remove("a")


@meeting
async def test_what_moderators_decided_holds_after_all_have_gone(place):
    chair, ada, eve = (
        await place.guest(moderator=True),
        await place.guest(),
        await place.guest(name="Eve"),
    )
    await chair.say(kind="moderate", action="mute", number=ada.number)
    await chair.say(kind="moderate", action="remove", number=eve.number)
    await chair.say(kind="moderate", action="lock")
    await ada.told(Door)
    for guest in (ada, chair):
        await guest.say(kind="leave")
        await guest.end()
    while "room_rooms 0\n" not in await (await place.session.get(f"{place.address}/metrics")).text():
        await asyncio.sleep(0.01)
    _, refused = await (await place.come(secret=eve.secret)).end()
    assert "removed you" in refused[0].text
    _, refused = await (await place.come(name="new")).end()
    assert "locked" in refused[0].text
    chair = await place.guest(moderator=True)
    assert chair.welcome.locked
    await chair.say(kind="moderate", action="unlock")
    await chair.told(Door)
    again = await place.guest(secret=ada.secret)
    assert [person.muted for person in again.welcome.people if person.id == again.welcome.id] == [True]


@given(st.lists(st.tuples(st.sampled_from("abc"), st.floats(0, KEPT_S)), max_size=20))
def test_rulings_are_kept_for_so_long_after_a_room_was_last_in_use(uses):
    kept, now, last = KeptRulings(), 0.0, {}
    for name, later in uses:
        now += later
        room = Meeting(most_people=4)
        kept.restore(name, room, now=now)
        assert room.rulings.is_removed("eve") == (name in last and now - last[name] <= KEPT_S)
        room.rulings.remove("eve")
        kept.keep(name, room, now=now)
        last[name] = now


def test_of_too_many_empty_rooms_the_longest_empty_is_forgotten():
    kept = KeptRulings()
    for number in range(MOST_KEPT + 1):
        room = Meeting(most_people=4)
        room.rulings.remove("eve")
        kept.keep(str(number), room, now=0.0)
    held = []
    for number in range(MOST_KEPT + 1):
        room = Meeting(most_people=4)
        kept.restore(str(number), room, now=0.0)
        held.append(room.rulings.is_removed("eve"))
    assert held == [False] + [True] * MOST_KEPT
