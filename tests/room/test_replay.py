"""A recording that is played in a room: the same states at the same pace, for all who look; halts, jumps and paces."""

import asyncio
from dataclasses import replace
from pathlib import Path

import pytest

from room.errors import NotAllowed
from room.protocol import Message, decode
from room.protocol.answers import Changed, Left, Notice, Playing
from room.protocol.message import time_of
from room.protocol.texts import Play
from room.recording import check_recording, read_recording
from room.recording.lines import Came, Gone, Tick
from room.server.limits import PLAYS_PER_S
from room.server.replay import Replay
from room.state import Meeting
from tests.room.guests import Guest, open_room, secret_for
from tests.room.recordings import recorded

LATE_S = 10.0
"""A replay is never quicker than it should be; a slow machine with other work may show its end late."""


def _names(path: Path) -> dict[int, str]:
    return {line.number: line.name for line in read_recording(path) if isinstance(line, Came)}


def test_a_replay_sends_the_same_states_at_the_same_pace_and_begins_again(tmp_path):
    path = recorded(tmp_path / "meeting.jsonl")
    ticks = [line for line in read_recording(path) if isinstance(line, Tick)]
    before = {
        name: [decode(content) for tick in ticks for number, content in tick.states if number == at]
        for at, name in _names(path).items()
    }

    async def run() -> None:
        async with open_room(replayed=path) as place:
            viewer = await place.guest(name="Viewer")
            assert viewer.welcome.replay
            await viewer.until(lambda: viewer.sequences)
            begun = asyncio.get_running_loop().time()
            told: dict[str, list[int]] = {"Ada": [], "Ben": []}
            numbers: dict[int, str] = {}
            replaying = viewer.told(Changed, lambda changed: changed.person.name == "Ben")
            ben = (await replaying).person
            assert (ben.replayed, ben.recorded, ben.voice) == (True, False, False)
            assert ben.id.startswith("replay-")
            assert (await viewer.told(Left)).number == ben.number
            await viewer.until(lambda: len(viewer.sequences) == 30)
            took = asyncio.get_running_loop().time() - begun
            length_s = (ticks[-1].time_ms - ticks[0].time_ms) / 1000
            assert length_s - 0.2 < took < length_s + LATE_S
            numbers |= {
                changed.person.number: changed.person.name
                for changed in viewer.all(Changed)
                if changed.person.replayed
            }
            for number, sequence in viewer.sequences:
                told[numbers[number]].append(sequence)
            assert told == {name: [state.sequence for state in those] for name, those in before.items()}
            ada = next(number for number, name in numbers.items() if name == "Ada")
            assert viewer.states[ada] == before["Ada"][-1]
            seen = len(viewer.all(Left))
            await viewer.until(lambda: len(viewer.all(Left)) > seen)  # the end of the first round
            await viewer.until(lambda: len(viewer.sequences) > 35)

    asyncio.run(run())


def test_a_replay_halts_jumps_and_goes_faster_for_all_who_look(tmp_path):
    path = recorded(tmp_path / "meeting.jsonl")
    ticks = [line for line in read_recording(path) if isinstance(line, Tick)]
    survey = check_recording(path)
    names = _names(path)
    ada = [
        (tick.time_ms, decode(state))
        for tick in ticks
        for number, state in tick.states
        if names[number] == "Ada"
    ]
    length_s = (survey.ends_ms - survey.begins_ms) / 1000

    def cast(guest: Guest) -> set[int]:
        """Numbers of the recorded Ada."""
        people = {person.number: person for person in guest.welcome.people}
        people |= {changed.person.number: changed.person for changed in guest.all(Changed)}
        return {number for number, person in people.items() if person.replayed and person.name == "Ada"}

    def known(state: Message) -> tuple[int, int]:
        return state.sequence, state.animation

    def shown(guest: Guest) -> list[tuple[int, int]]:
        return [known(guest.states[number]) for number in guest.states.keys() & cast(guest)]

    async def run() -> None:
        async with open_room(replayed=path) as place:
            viewer, other = await place.guest(name="Viewer"), await place.guest(name="Other")
            assert (await other.told(Playing)).length_s == pytest.approx(length_s)
            for time_s in (0.3, length_s, 0.0, 0.5):
                await viewer.say(kind="play", time_s=time_s, paused=True)
                told = await other.told(
                    Playing, lambda answer, at=time_s: answer.paused and abs(answer.time_s - at) < 1e-6
                )
                assert told.speed == 1
                due = [known(state) for at, state in ada if at <= survey.begins_ms + time_s * 1000]
                await other.until(lambda due=due: shown(other) == due[-1:])
            (number,) = other.states.keys() & cast(other)
            # halted: the same state again and again, at times that go on, so that no page lets the face sink
            first = other.states[number]
            await other.until(lambda: other.states[number].time_ms >= first.time_ms + 700)
            assert replace(other.states[number], time_ms=0) == replace(first, time_ms=0)
            begun = asyncio.get_running_loop().time()
            await viewer.say(kind="play", time_s=0.0, paused=False, speed=0.5)
            await other.until(lambda: shown(other) == [known(ada[-1][1])])
            took = asyncio.get_running_loop().time() - begun
            assert length_s / 0.5 - 0.4 < took < length_s / 0.5 + LATE_S
            (number,) = other.states.keys() & cast(other)
            slow = other.states[number].time_ms - ada[0][1].time_ms
            assert slow == pytest.approx(2 * (ada[-1][1].time_ms - ada[0][1].time_ms), abs=150)
            await viewer.say(kind="play", speed=9)
            end = await viewer.end()
            assert "speed" in end[1][0].text, "no such pace"
            await other.say(kind="play", time_s=0.0, speed=8)
            await other.told(Playing, lambda answer: answer.speed == 8)
            seen = len(other.all(Left))
            await other.until(lambda: len(other.all(Left)) > seen)

    asyncio.run(run())


def test_at_eight_times_the_speed_it_is_over_in_an_eighth_of_the_time(tmp_path):
    survey = check_recording(recorded(tmp_path / "meeting.jsonl"))
    replay, meeting = Replay(survey), Meeting(most_people=8)
    replay.step(meeting, now=0.0)
    replay.play(Play(speed=8), meeting, now=0.0)
    (gone,) = (
        line
        for line in read_recording(survey.path)
        if isinstance(line, Gone) and line.time_ms < survey.ends_ms
    )
    left_s = (gone.time_ms - survey.begins_ms) / 8000
    assert not any(isinstance(word, Left) for word in replay.step(meeting, now=left_s - 0.001))
    assert any(isinstance(word, Left) for word in replay.step(meeting, now=left_s + 0.001))


def test_where_people_meet_nothing_is_played():
    async def run() -> None:
        async with open_room() as place:
            guest = await place.guest()
            await guest.say(kind="play", paused=True)
            assert "nothing to play" in (await guest.told(Notice)).text

    asyncio.run(run())


def test_nobody_can_be_somebody_of_a_replay_and_a_moderator_may_remove_them(tmp_path):
    path = recorded(tmp_path / "meeting.jsonl")

    async def run() -> None:
        async with open_room(replayed=path) as place:
            chair = await place.guest(moderator=True)
            await chair.told(Changed, lambda changed: changed.person.name == "Ben")
            ada = (await chair.told(Changed, lambda changed: changed.person.name == "Ada")).person
            await chair.say(kind="moderate", action="remove", number=ada.number)
            await chair.told(Left, lambda left: left.number == ada.number)
            await chair.until(lambda: len(chair.sequences) > 3)
            late = await place.guest(name="Late", secret=secret_for(ada.number))
            assert {person.replayed for person in late.welcome.people} == {True, False}
            assert len({person.number for person in late.welcome.people}) == len(late.welcome.people)
            assert late.number == ada.number, "free again"
            before = len(chair.all(Left))
            await chair.until(lambda: len(chair.all(Left)) > before + 1 or len(chair.sequences) > 30)
            assert late.number not in {left.number for left in chair.all(Left)[before:]}

    asyncio.run(run())


def test_clocks_go_on_evenly_where_a_replay_is_halted(tmp_path):
    """A page would not show what is older than what it has: a face would stand still for as long as the halt was."""
    replay = Replay(check_recording(recorded(tmp_path / "meeting.jsonl")))
    meeting = Meeting(most_people=8)
    sent: dict[int, list[int]] = {}
    for step in range(24):
        now = step / 30
        if step in (8, 16):
            replay.play(Play(paused=step == 8), meeting, now=now)
        replay.step(meeting, now=now)
        for seat in meeting.seats:
            sent.setdefault(seat.number, []).extend(map(time_of, seat.taken()))
    assert all(times == sorted(times) for times in sent.values())
    longest_ms = max(times[-1] - times[0] for times in sent.values())  # one of the two leaves
    assert longest_ms == pytest.approx(24 / 30 * 1000, abs=200)


def test_a_replay_that_is_asked_too_much_goes_on_as_it_was(tmp_path):
    """Each jump reads the file, for all who look."""
    replay, meeting = Replay(check_recording(recorded(tmp_path / "meeting.jsonl"))), Meeting(most_people=8)
    for _ in range(2 * PLAYS_PER_S):
        replay.play(Play(paused=True), meeting, now=0.0)
    with pytest.raises(NotAllowed, match="that was too fast; the replay goes on as it was"):
        replay.play(Play(paused=False), meeting, now=0.0)
    assert replay.playing(now=0.0).paused
    assert not replay.play(Play(paused=False), meeting, now=1 / PLAYS_PER_S)[-1].paused
