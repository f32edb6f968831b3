"""What moderators have decided of people holds for those who leave and come back, and takes no more than its room."""

import pytest

from room.protocol.texts import Join, Moderate
from room.state import Meeting, Seat
from room.state.meeting import KEEP_S
from room.state.rulings import MOST_RULED, Rulings

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
