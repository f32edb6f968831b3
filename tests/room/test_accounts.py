"""What several processes know of one room comes to be the same, however their words are mixed."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from room.errors import NotAllowed
from room.protocol.accounts import Account, Moves, pack_moves, read_word
from room.protocol.message import Message, encode
from room.protocol.texts import Join, Moderate
from room.state import Meeting, identity
from room.state.accounts import account, merge
from tests.room.guests import secret_for

SECRETS = [letter * 22 for letter in "abcd"]
PROCESSES = ["1" * 16, "2" * 16, "3" * 16]

steps = st.lists(
    st.tuples(
        st.sampled_from(
            [
                "enter",
                "away",
                "leave",
                "mute",
                "unmute",
                "remove",
                "undress",
                "lock",
                "unlock",
                "share",
                "unshare",
                "hear",
            ]
        ),
        st.integers(0, 2),
        st.integers(0, 3),
        st.integers(0, 2),
    ),
    max_size=40,
)


def _do(meetings: list[Meeting], act: str, at: int, whom: int, by: int) -> None:
    meeting = meetings[at]
    seat = meeting.seat(identity(SECRETS[whom]))
    if act == "hear":
        merge(meeting, account(meetings[by]), now=0.0)
    elif act == "enter":
        join = Join(key="k" * 22, secret=SECRETS[whom], name=f"Person {whom}", visit=f"v{at}", at_ms=3 * by)
        try:
            meeting.enter(join, moderator=True)
        except NotAllowed:
            return
    elif seat and seat.home == meeting.process and act in ("away", "leave"):
        if act == "leave":
            meeting.leave(seat)
        else:
            seat.gone_at = 0.0
    elif act == "share" and seat and seat.home == meeting.process:
        try:
            meeting.share(seat, on=True)
        except NotAllowed:
            return
    elif act in ("lock", "unlock", "unshare", "mute", "unmute", "remove", "undress") and seat:
        chair = next((other for other in meeting.seats if other is not seat), None)
        if chair:
            meeting.moderate(chair, Moderate(action=act, number=seat.number))


def _known(meeting: Meeting) -> tuple:
    people = sorted(
        (
            seat.id,
            seat.number,
            seat.name,
            seat.visit,
            seat.gone_at is None,
            seat.muted,
            seat.home,
            seat.entry,
            seat.shares,
        )
        for seat in meeting.seats
    )
    rulings = meeting.rulings
    return meeting.locked, set(rulings.removed), set(rulings.undressed), dict(rulings.mutes), people


@settings(max_examples=150, deadline=None)
@given(steps)
def test_all_processes_come_to_know_the_same(acts):
    meetings = [Meeting(most_people=64, process=process) for process in PROCESSES]
    for act, at, whom, by in acts:
        _do(meetings, act, at, whom, by)
    for _ in range(4):  # an account is said every two seconds
        for meeting in meetings:
            said = read_word(account(meeting).model_dump_json().encode())
            for other in meetings:
                if other is not meeting:
                    merge(other, said, now=0.0)
    assert _known(meetings[0]) == _known(meetings[1]) == _known(meetings[2])
    numbers = [seat.number for seat in meetings[0].seats]
    assert len(set(numbers)) == len(numbers), "no two have one number"
    assert not {seat.id for seat in meetings[0].seats} & set(meetings[0].rulings.removed)


@settings(max_examples=50, deadline=None)
@given(steps)
def test_an_account_that_is_heard_twice_changes_nothing_more(acts):
    meetings = [Meeting(most_people=64, process=process) for process in PROCESSES]
    for act, at, whom, by in acts:
        _do(meetings, act, at, whom, by)
    said = account(meetings[0])
    merge(meetings[1], said, now=0.0)
    again = merge(meetings[1], said, now=0.0)
    assert (again.told, again.ousted) == ([], [])


def test_of_two_with_one_number_the_smaller_id_keeps_it_and_the_other_comes_in_anew():
    one, two = (Meeting(most_people=8, process=process) for process in PROCESSES[:2])
    for meeting, secret in ((one, secret_for(3)), (two, secret_for(3))):
        meeting.enter(Join(key="k" * 22, secret=secret, name="Who"), moderator=False)
    smaller, greater = sorted((one, two), key=lambda meeting: meeting.seats[0].id)
    assert smaller.seats[0].number == greater.seats[0].number
    keeps, goes = smaller.seats[0].id, greater.seats[0].id
    assert merge(smaller, account(greater), now=0.0).ousted == []
    ousted = merge(greater, account(smaller), now=0.0).ousted
    assert [(each.id, each.again) for each in ousted] == [(goes, True)]
    assert [seat.id for seat in greater.seats] == [keeps]


def test_states_between_processes_are_read_as_they_were_written():
    states = ((3, encode(Message(sequence=7))), (65535, encode(Message())))
    for part in ("page", "face"):
        assert read_word(pack_moves(PROCESSES[0], part, states)) == Moves(
            process=PROCESSES[0], part=part, states=states
        )


def test_an_account_of_the_fullest_room_is_within_its_bound():
    from room.protocol.accounts import MOST_RESIDENTS, MOST_WORD_BYTES, Mute, Resident

    resident = Resident(
        number=65535,
        id="f" * 16,
        name="\u4e00" * 40,
        avatar="a" * 32,
        visit="v" * 22,
        moderator=False,
        present=False,
        voice=False,
        entry=2**53,
    )
    full = Account(
        process="f" * 16,
        people=(resident,) * MOST_RESIDENTS,
        mutes=(Mute(id="f" * 16, muted=False, acts=2**53),) * MOST_RESIDENTS,
        removed=("f" * 16,) * MOST_RESIDENTS,
        undressed=("f" * 16,) * MOST_RESIDENTS,
    )
    content = full.model_dump_json().encode()
    assert len(content) < MOST_WORD_BYTES
    assert read_word(content) == full


@pytest.mark.parametrize(
    "act",
    [
        *("mute", "unmute", "undress", "lock", "unlock", "remove", "leave"),
        *("come in by another", "come back", "away"),
    ],
)
def test_a_word_that_comes_late_takes_nothing_back(act):
    """What a process said before an act may arrive after it; then the act still counts, everywhere."""
    meetings = [
        Meeting(most_people=64, process=process, first_number=number)
        for number, process in enumerate(PROCESSES)
    ]
    for at, whom in ((0, 0), (1, 1), (2, 2)):
        _do(meetings, "enter", at, whom, 0)
    _exchange(meetings)
    if act in ("unmute", "unlock"):
        _do(meetings, act.removeprefix("un"), 0, 0, 0)
        assert meetings[0].locked or meetings[0].seats[0].muted
        _exchange(meetings)
    assert all(len(meeting.seats) == 3 for meeting in meetings)
    late = [account(meeting) for meeting in meetings]
    if act == "come in by another":
        _do(meetings, "enter", 1, 0, 0)
    elif act == "come back":
        _do(meetings, "away", 0, 0, 0)
        _do(meetings, "enter", 0, 0, 0)
    else:
        _do(meetings, act, 0, 0, 0)
    actor = meetings[1 if act == "come in by another" else 0]
    for meeting in meetings:
        if meeting is not actor:
            merge(meeting, account(actor), now=0.0)
    known = _known(meetings[2])
    for said in late[::-1]:
        for meeting in meetings:
            if meeting.process != said.process:
                merge(meeting, said, now=0.0)
    if act in ("mute", "unmute", "undress", "lock", "unlock", "remove"):  # not even for a moment
        assert all(_known(meeting) == known for meeting in meetings)
    _exchange(meetings)
    assert _known(meetings[0]) == _known(meetings[1]) == _known(meetings[2]) == known


def _exchange(meetings: list[Meeting]) -> None:
    for _ in range(3):
        for meeting in meetings:
            for other in meetings:
                if other is not meeting:
                    merge(other, account(meeting), now=0.0)


def test_what_a_moderator_decided_of_somebody_who_left_holds_wherever_they_come_back():
    one, two, three = (
        Meeting(most_people=8, process=process, first_number=number)
        for number, process in enumerate(PROCESSES)
    )
    for whom in (0, 1):
        _do([one], "enter", 0, whom, 0)
    _do([one], "mute", 0, 0, 0)
    _do([one], "undress", 0, 0, 0)
    _do([one], "leave", 0, 0, 0)
    merge(two, account(one), now=0.0)  # which had not heard of them before
    merge(three, account(two), now=0.0)
    for meeting in (one, two, three):
        _do([meeting], "enter", 0, 0, 0)
        assert meeting.seat(identity(SECRETS[0])).muted
        assert meeting.rulings.is_undressed(identity(SECRETS[0]))


def test_an_avatar_that_was_taken_off_does_not_come_back_with_a_late_word():
    one, two = (Meeting(most_people=8, process=process) for process in PROCESSES[:2])
    for whom in (0, 1):
        _do([one], "enter", 0, whom, 0)
    one.seats[0].own = "f" * 64
    merge(two, account(one), now=0.0)
    assert two.seat(one.seats[0].id).own
    late = account(one)
    two.moderate(two.seats[1], Moderate(action="undress", number=two.seats[0].number))
    assert not merge(two, late, now=0.0).told
    assert merge(one, account(two), now=0.0).undressed == [one.seats[0].id]


@pytest.mark.parametrize("first", [0, 1])
def test_who_goes_on_before_the_first_process_has_told_stays_where_they_went(first):
    """Both processes have counted one coming: of their names alone one window in two would be turned out."""
    order = [Meeting(most_people=8, process=PROCESSES[at]) for at in (first, 1 - first)]
    for at, meeting in enumerate(order):
        join = Join(key="k" * 22, secret=SECRETS[0], name="Ada", visit=f"v{at}", at_ms=10**12 + at)
        meeting.enter(join, moderator=False)
    said = [account(meeting) for meeting in order]
    assert not merge(order[1], said[0], now=0.0).ousted, "the newer window"
    assert [ousted.again for ousted in merge(order[0], said[1], now=0.0).ousted] == [False]
    assert {meeting.seats[0].home for meeting in order} == {order[1].process}


def test_a_clock_that_goes_back_takes_nobody_from_where_they_went():
    meeting = Meeting(most_people=8, process=PROCESSES[0])
    for at_ms in (10**12, 5):
        seat = meeting.enter(Join(key="k" * 22, secret=SECRETS[0], name="Ada", at_ms=at_ms), moderator=False)
    assert seat.entry == 10**12 + 1
