"""A room as people meet it, over real WebSockets: who comes in, who hears of what, and what a moderator may do."""

import asyncio
import time

import pytest

from room.protocol.answers import Changed, Door, Left, Line, Notice, Refused, Signal
from room.server.connection import CLOSED_BY_RULE
from room.state import identity
from tests.room.guests import meeting, open_room

WEIGHTS = tuple(step / 255 for step in range(52))


@meeting
async def test_two_people_see_each_other_move(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    assert {person.name for person in ben.welcome.people} == {"Ada", "Ben"}
    changed = await ada.told(Changed)
    assert (changed.person.name, changed.person.number) == ("Ben", ben.number)
    await ada.move(weights=WEIGHTS, floor_m=(1.5, -2.0), sequence=7)
    await ben.until(lambda: ada.number in ben.states)
    seen = ben.states[ada.number]
    assert (seen.weights, seen.floor_m, seen.sequence) == (WEIGHTS, (1.5, -2.0), 7)


@meeting
async def test_who_comes_late_gets_the_roster_and_the_last_states(place):
    ada = await place.guest()
    await ada.move(heading=1.0)
    await ada.until(lambda: ada.number in ada.states)
    ben = await place.guest(name="Ben")
    await ben.until(lambda: ada.number in ben.states)
    assert ben.states[ada.number].heading == pytest.approx(1.0, abs=1e-4)


@meeting
async def test_all_get_one_tick_for_many_states_and_none_when_nobody_moves(place):
    guests = [await place.guest(name=f"Guest {index}") for index in range(4)]
    start, before = time.monotonic(), guests[0].ticks
    for step in range(30):
        for guest in guests:
            await guest.move(sequence=step)
        await asyncio.sleep(1 / 30)
    await guests[0].until(lambda: len(guests[0].states) == 4)
    ticks, seconds = guests[0].ticks - before, time.monotonic() - start
    assert ticks <= 30 * seconds + 2, "one buffer a tick, however many people move"
    await guests[0].until(lambda: len(guests[0].sequences) == 120)
    sent = sorted((guest.number, step) for guest in guests for step in range(30))
    assert sorted(guests[0].sequences) == sent, "none is lost"
    quiet = guests[0].ticks
    await asyncio.sleep(0.3)
    assert guests[0].ticks - quiet <= 1


@meeting
async def test_who_comes_back_has_the_same_number_and_stands_where_they_stood(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    await ada.move(floor_m=(3.0, 4.0))
    await ben.until(lambda: ada.number in ben.states)
    await ada.go()
    await ben.told(
        Changed, lambda changed: changed.person.number == ada.number and not changed.person.present
    )
    again = await place.guest(secret=ada.secret)
    assert (again.number, again.welcome.id) == (ada.number, ada.welcome.id)
    await again.until(lambda: again.number in again.states)
    assert again.states[again.number].floor_m == (3.0, 4.0)
    assert ada.welcome.id == identity(ada.secret) != ada.secret


@meeting
async def test_all_hear_who_lost_a_name_to_a_moderator(place):
    guest, ben = await place.guest(name="Chair"), await place.guest(name="Ben")
    chair = await place.guest(name="chair", moderator=True)
    assert {person.name for person in chair.welcome.people} == {"Chair 2", "Ben", "chair"}
    for each in (guest, ben):
        await each.told(
            Changed,
            lambda changed: (changed.person.number, changed.person.name) == (guest.number, "Chair 2"),
        )


@meeting
async def test_who_leaves_is_gone_at_once(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    await ada.say(kind="leave")
    assert (await ben.told(Left)).number == ada.number
    assert [person.name for person in (await place.guest(name="Cy")).welcome.people] == ["Ben", "Cy"]


@meeting
async def test_a_second_window_takes_the_place_of_the_first(place):
    ada = await place.guest()
    again = await place.guest(secret=ada.secret)
    code, words = await ada.end()
    assert code == CLOSED_BY_RULE
    assert not words[0].again
    assert len(again.welcome.people) == 1


@meeting
async def test_a_program_moves_the_face_and_nothing_else_and_gives_it_back(place):
    ben, ada = await place.guest(name="Ben"), await place.guest()
    await ada.move(flags=1, floor_m=(2.0, 2.0), animation=1, weights=(0.2,) * 52)
    program = await place.guest(secret=ada.secret, role="face")
    await program.move(flags=2, floor_m=(9.0, 9.0), animation=5, weights=WEIGHTS, gaze=(0.1,) * 4)
    changed = await ben.told(Changed, lambda changed: changed.person.face == "program")
    assert changed.person.number == ada.number
    await ben.until(lambda: ada.number in ben.states and ben.states[ada.number].weights == WEIGHTS)
    seen = ben.states[ada.number]
    assert (seen.flags, seen.floor_m, seen.animation) == (3, (2.0, 2.0), 1)
    assert seen.gaze[0] == pytest.approx(0.1, abs=0.005)
    await program.go()
    await ben.told(Changed, lambda changed: changed.person.face == "page")
    await ada.move(weights=(0.2,) * 52)
    await ben.until(lambda: ben.states[ada.number].weights[0] == 0.2)


def test_a_program_may_come_back_to_who_was_away_for_long(monkeypatch):
    """`track` ends for good at a word that says so; its person has only lost the network for a while."""
    monkeypatch.setattr("room.state.meeting.KEEP_S", 0.1)

    async def run() -> None:
        async with open_room() as place:
            ada = await place.guest()
            program = await place.guest(secret=ada.secret, role="face")
            await ada.go()
            _, words = await program.end()
            assert [word.again for word in words] == [True]
            ada = await place.guest(secret=ada.secret)
            program = await place.guest(secret=ada.secret, role="face")
            await ada.say(kind="leave")
            _, words = await program.end()
            assert [word.again for word in words] == [False]

    asyncio.run(run())


@meeting
async def test_chat_and_calls_go_to_whom_they_are_for(place):
    ada, ben, cy = await place.guest(), await place.guest(name="Ben"), await place.guest(name="Cy")
    await ada.say(kind="chat", text="<b>hello</b>")
    for guest in (ada, ben, cy):
        assert (await guest.told(Line)).text == "<b>hello</b>"
    await ada.say(kind="description", to=ben.number, type="offer", sdp="v=0")
    signal = await ben.told(Signal)
    assert (signal.sender, signal.signal.sdp) == (ada.number, "v=0")
    await ada.say(kind="candidate", to=999, candidate="")
    await ada.say(kind="voice", open=True)
    assert (await cy.told(Changed, lambda changed: changed.person.voice)).person.number == ada.number
    assert not cy.all(Signal)


@meeting
async def test_a_moderator_mutes_removes_and_locks(place):
    chair, ada, ben = await place.guest(moderator=True), await place.guest(), await place.guest(name="Ben")
    assert chair.welcome.moderator
    for guest in (chair, ada):
        await guest.say(kind="chat", text=str(guest.number))
        line = await ben.told(Line, lambda line, guest=guest: line.text == str(guest.number))
        assert line.moderator == (guest is chair), "whatever names they have"
    await chair.say(kind="moderate", action="mute", number=ada.number)
    await ben.told(Changed, lambda changed: changed.person.muted)
    await ada.move(flags=1 | 2)
    await ben.until(lambda: ada.number in ben.states)
    assert ben.states[ada.number].flags == 2, "who is muted has no speaking sign"
    await ada.say(kind="chat", text="still here")
    assert "muted" in (await ada.told(Notice)).text
    await chair.say(kind="moderate", action="remove", number=ada.number)
    assert (await ada.end())[1][0].text == "a moderator has removed you from this room"
    assert (await ben.told(Left)).number == ada.number
    back = await place.come(secret=ada.secret)
    assert not (await back.end())[1][0].again
    await chair.say(kind="moderate", action="lock")
    await ben.told(Door, lambda door: door.locked)
    assert "locked" in (await (await place.come(name="Cy")).end())[1][0].text
    await ben.go()
    assert (await place.guest(secret=ben.secret)).number == ben.number, (
        "a lock keeps nobody's own place from them"
    )


@pytest.mark.parametrize("action", ["mute", "unmute", "unshare", "remove", "lock", "unlock"])
def test_a_guest_moderates_nobody(action):
    async def run() -> None:
        async with open_room() as place:
            ada, ben = await place.guest(), await place.guest(name="Ben")
            await ada.say(kind="moderate", action=action, number=ben.number)
            assert "moderator" in (await ada.told(Notice)).text
            assert not ben.all(Left) + ben.all(Door) + ben.all(Refused)

    asyncio.run(run())
