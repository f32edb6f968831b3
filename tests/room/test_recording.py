"""A recorded room over real WebSockets: who is in the file, what a killed server leaves, and its replay."""

import asyncio
import base64
import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import aiohttp
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES
from room.errors import FormatError, InputError
from room.protocol import Message, decode, encode
from room.protocol.texts import Changed, Left, Notice, Person, Playing
from room.protocol.tick import pack
from room.recording import Recorder, check_recording, follow_recording, read_recording
from room.recording.lines import Came, Gone, Heading, Tick
from room.recording.writer import MOST_WAITING
from room.server.hall import HERTZ
from tests.room.guests import Guest, Place, open_room

ROOT = Path(__file__).resolve().parents[2]


def make_recorder(path: Path, *, ended: Callable[[str], None] = pytest.fail, **options: int) -> Recorder:
    return Recorder(path, room="meeting", hertz=HERTZ, ended=ended, **options)


def states(path: Path) -> list[tuple[int, Message]]:
    ticks = (line for line in read_recording(path) if isinstance(line, Tick))
    return [(number, decode(state)) for tick in ticks for number, state in tick.states]


async def walk(guest: Guest, *, steps: int = 20, **state: object) -> None:
    for step in range(steps):
        await guest.move(sequence=step, time_ms=step * 33, **state)
        await asyncio.sleep(1 / HERTZ)


def test_only_who_agreed_is_in_the_file_and_everybody_sees_who_that_is(tmp_path):
    path = tmp_path / "meeting.jsonl"

    async def run() -> None:
        recorder = make_recorder(path)
        async with open_room(recorder=recorder) as place:
            async with place.session.get(f"{place.address}/room/meeting/about.json") as answer:
                assert await answer.json() == {"recording": True, "replay": False, "engine": False}
            async with place.session.get(f"{place.address}/room/other/about.json") as answer:
                assert await answer.json() == {"recording": False, "replay": False, "engine": False}
            chair = await place.guest(moderator=True, name="Chair")
            ada = await place.guest(recorded=True)
            ben = await place.guest(name="Ben Declines")
            assert ben.welcome.recording
            assert {person.name: person.recorded for person in ben.welcome.people} == {
                "Chair": False,
                "Ada": True,
                "Ben Declines": False,
            }
            assert (await chair.told(Changed, lambda told: told.person.name == "Ada")).person.recorded
            await asyncio.gather(walk(ada, floor_m=(1.0, 2.0)), walk(ben, floor_m=(7.0, 7.0)))
            await ada.say(kind="chat", text="not for the file")
            await chair.until(lambda: (ada.number, 19) in chair.sequences)
            recorder.settle()
            seen = {state for number, state in states(path) if number == ada.number}
            assert len(seen) == 20
            assert {state.floor_m for _, state in states(path)} == {(1.0, 2.0)}
        text = path.read_text()
        assert ben.welcome.id not in text
        assert "Ben" not in text
        assert "not for the file" not in text
        assert ada.secret not in text

    asyncio.run(run())


def test_consent_is_taken_back_and_given_at_once(tmp_path):
    path = tmp_path / "meeting.jsonl"

    async def run() -> None:
        async with open_room(recorder=make_recorder(path)) as place:
            ada, ben = await place.guest(recorded=True), await place.guest(name="Ben")
            await walk(ada, steps=3)
            await ada.say(kind="consent", recorded=False)
            await ben.told(
                Changed, lambda told: told.person.number == ada.number and not told.person.recorded
            )
            await walk(ada, steps=3, animation=5)
            await ben.say(kind="consent", recorded=True)
            await ada.told(Changed, lambda told: told.person.recorded)
            await walk(ben, steps=3, animation=6)
            # who comes back by a page that says nothing of consent is not recorded
            again = await place.guest(secret=ben.secret, name="Ben")
            await walk(again, steps=3, animation=4)

    asyncio.run(run())
    assert {(number, state.animation) for number, state in states(path)} == {(0, 0), (1, 6)}
    kinds = [type(line) for line in read_recording(path) if not isinstance(line, Tick)]
    assert kinds == [Heading, Came, Gone, Came, Gone]


def test_other_rooms_of_the_server_are_not_recorded(tmp_path):
    path = tmp_path / "meeting.jsonl"

    async def run() -> None:
        async with open_room(recorder=make_recorder(path)) as place:
            other = Place(place.address, place.keys, "other")
            ada = await other.guest(recorded=True)
            assert not ada.welcome.recording
            assert not ada.welcome.people[0].recorded
            await ada.say(kind="consent", recorded=True)
            assert "not recorded" in (await ada.told(Notice)).text
            await walk(ada, steps=3)
            await other.session.close()

    asyncio.run(run())
    assert [type(line) for line in read_recording(path)] == [Heading]
    with pytest.raises(FormatError, match="nobody"):
        check_recording(path)


def test_a_disk_that_stalls_holds_up_nobody(tmp_path, monkeypatch):
    """Ticks go on while a line cannot be written; after ten seconds' lines the recording ends with a word."""
    path, said, stalled = tmp_path / "meeting.jsonl", [], threading.Event()
    recorder = make_recorder(path, ended=said.append)
    monkeypatch.setattr(recorder, "_put", lambda file, line: stalled.wait())

    async def run() -> None:
        async with open_room() as place:
            people = [
                (await place.guest(recorded=True)).welcome.people[0].model_copy(update={"recorded": True})
            ]
            recorder.roster(people)
            content = pack([(people[0].number, encode(Message()))], time_ms=0)
            start = time.monotonic()
            for _ in range(MOST_WAITING + 2):
                recorder.tick(content)
            assert time.monotonic() - start < 1
            assert ["does not keep up" in text for text in said] == [True]
            assert not recorder.open
            stalled.set()

    asyncio.run(run())
    recorder.close()


@pytest.mark.parametrize("limit", ["bytes", "disk"])
def test_a_recording_that_cannot_go_on_ends_and_the_meeting_does_not(limit, tmp_path):
    path, said = tmp_path / "meeting.jsonl", []
    recorder = make_recorder(path, ended=said.append, most_bytes=4096 if limit == "bytes" else 10**9)
    resource = pytest.importorskip("resource", reason="limits the size of files")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)

    async def run() -> None:
        async with open_room(recorder=recorder) as place:
            ada, ben = await place.guest(recorded=True), await place.guest(name="Ben")
            if limit == "disk":  # the system refuses as it does on a full disk, in the middle of a line
                resource.setrlimit(resource.RLIMIT_FSIZE, (4000, before[1]))
            await walk(ada, steps=40)
            assert "recording has ended" in (await ben.told(Notice)).text
            assert not (
                await ben.told(Changed, lambda told: told.person.number == ada.number)
            ).person.recorded
            assert not (await place.guest(name="Cy", recorded=True)).welcome.recording
            await ben.until(lambda: (ada.number, 39) in ben.sequences)

    try:
        asyncio.run(run())
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert len(said) == 1
    assert str(path) in said[0]
    assert path.stat().st_size <= 4096
    assert len(states(path)) > 5


def test_a_killed_server_leaves_a_readable_file(tmp_path):
    path = tmp_path / "meeting.jsonl"
    command = (sys.executable, "-m", "room", "serve", "--port", "0", "--record", str(path))
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}

    async def meet(address: str, key: str) -> int:
        async with aiohttp.ClientSession() as session, session.ws_connect(f"{address}/socket") as socket:
            join = {"kind": "join", "key": key, "secret": "s" * 22, "name": "Ada", "recorded": True}
            await socket.send_json(join)
            guest = Guest(socket, "")
            await walk(guest, steps=30)
            await guest.until(lambda: (0, 29) in guest.sequences)
            await asyncio.sleep(0.2)  # the thread that writes has its turn, on a loaded machine too
            run.kill()
            await guest.reading
            return len(guest.sequences)

    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as run:
        link = run.stdout.readline().split("\t")[2].strip()
        assert asyncio.run(meet(*link.split("#"))) == 30
    assert [state.sequence for _, state in states(path)] == list(range(30))
    assert path.stat().st_mode & 0o077 == 0
    again = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=30)
    assert (again.returncode, again.stderr.count("\n")) == (2, 1)
    assert "there already" in again.stderr


def recorded(path: Path) -> Path:
    """A short recording of two people, one of whom leaves."""

    async def run() -> None:
        async with open_room(recorder=make_recorder(path)) as place:
            ada, ben = [await place.guest(name=name, recorded=True) for name in ("Ada", "Ben")]
            await asyncio.gather(walk(ada, steps=15, heading=0.5), walk(ben, steps=10, flags=1))
            await ben.say(kind="leave")
            await walk(ada, steps=5, animation=3)
            await ada.until(lambda: len(ada.sequences) == 30)

    asyncio.run(run())
    return path


def test_a_replay_sends_the_same_states_at_the_same_pace_and_begins_again(tmp_path):
    path = recorded(tmp_path / "meeting.jsonl")
    ticks = [line for line in read_recording(path) if isinstance(line, Tick)]
    before = {
        name: [decode(content) for tick in ticks for number, content in tick.states if number == at]
        for at, name in ((0, "Ada"), (1, "Ben"))
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
            assert took == pytest.approx((ticks[-1].time_ms - ticks[0].time_ms) / 1000, abs=0.2)
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
    ada = [(tick.time_ms, decode(state)) for tick in ticks for number, state in tick.states if number == 0]
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
            assert took == pytest.approx(length_s / 0.5, abs=0.4)
            (number,) = other.states.keys() & cast(other)
            slow = other.states[number].time_ms - ada[0][1].time_ms
            assert slow == pytest.approx(2 * (ada[-1][1].time_ms - ada[0][1].time_ms), abs=150)
            await viewer.say(kind="play", speed=9)
            end = await viewer.end()
            assert "speed" in end[1][0].text, "no such pace"
            await other.say(kind="play", time_s=0.0, speed=8)
            begun = asyncio.get_running_loop().time()
            await other.told(Playing, lambda answer: answer.speed == 8)
            seen = len(other.all(Left))
            await other.until(lambda: len(other.all(Left)) > seen)
            assert asyncio.get_running_loop().time() - begun < length_s / 2

    asyncio.run(run())


def test_where_people_meet_nothing_is_played():
    async def run() -> None:
        async with open_room() as place:
            guest = await place.guest()
            await guest.say(kind="play", paused=True)
            assert "nothing to play" in (await guest.told(Notice)).text

    asyncio.run(run())


def test_a_recording_can_be_followed_from_every_mark(tmp_path, monkeypatch):
    path = recorded(tmp_path / "meeting.jsonl")
    monkeypatch.setattr("room.recording.reader.MARKS_MS", 50)
    lines = list(read_recording(path))[1:]
    survey = check_recording(path)
    assert len(survey.marks) > 5
    for mark in survey.marks:
        rest = list(follow_recording(path, mark))
        before = lines[: len(lines) - len(rest)]
        assert [*before, *rest] == lines
        assert rest[0].time_ms == mark.time_ms
        there: dict[int, Came] = {}
        for line in before:
            if isinstance(line, Came):
                there[line.number] = line
            if isinstance(line, Gone):
                del there[line.number]
        assert mark.cast == there


def test_nobody_can_be_somebody_of_a_replay_and_a_moderator_may_remove_them(tmp_path):
    path = recorded(tmp_path / "meeting.jsonl")

    async def run() -> None:
        async with open_room(replayed=path) as place:
            chair = await place.guest(moderator=True)
            await chair.told(Changed, lambda changed: changed.person.name == "Ben")
            ada = (await chair.told(Changed, lambda changed: changed.person.id.endswith("-0"))).person
            await chair.say(kind="moderate", action="remove", number=ada.number)
            await chair.told(Left, lambda left: left.number == ada.number)
            await chair.until(lambda: len(chair.sequences) > 3)
            late = await place.guest(name="Late")
            assert {person.replayed for person in late.welcome.people} == {True, False}
            assert len({person.number for person in late.welcome.people}) == len(late.welcome.people)
            assert late.number == ada.number, "free again"
            before = len(chair.all(Left))
            await chair.until(lambda: len(chair.all(Left)) > before + 1 or len(chair.sequences) > 30)
            assert late.number not in {left.number for left in chair.all(Left)[before:]}

    asyncio.run(run())


GOOD = '{"kind":"recording","version":1,"room":"lab","began_s":1,"hertz":30,"shapes":SHAPES}\n'
CAME = '{"kind":"came","time_ms":5,"number":0,"id":"0123456789abcdef","name":"Ada","avatar":"plain"}\n'
BAD = {
    "nothing": "",
    "no recording": "hello\n",
    "another version": GOOD.replace('"version":1', '"version":2'),
    "other shapes": GOOD.replace("SHAPES", '["jawOpen"]'),
    "no heading": CAME,
    "a heading again": GOOD + GOOD,
    "a state of nobody": GOOD + '{"kind":"tick","time_ms":1,"states":[[0,"AAAA"]]}\n',
    "a state that is none": GOOD + CAME + '{"kind":"tick","time_ms":5,"states":[[0,"AAAA"]]}\n',
    "no base64": GOOD + CAME + '{"kind":"tick","time_ms":5,"states":[[0,"?"]]}\n',
    "back in time": GOOD + CAME + '{"kind":"gone","time_ms":4,"number":0}\n',
    "a name that turns the line": GOOD + CAME.replace("Ada", "\\u202eAda"),
    "nobody moves": GOOD + CAME,
    "more people than a room has": GOOD
    + "".join(CAME.replace('"number":0', f'"number":{number}') for number in range(1001))
    + f'{{"kind":"tick","time_ms":5,"states":[[0,"{base64.b64encode(encode(Message())).decode()}"]]}}\n',
}


@pytest.mark.parametrize("content", BAD.values(), ids=BAD.keys())
def test_what_is_no_recording_is_refused_with_its_line(content, tmp_path):
    path = tmp_path / "meeting.jsonl"
    path.write_text(content.replace("SHAPES", json.dumps(BLENDSHAPES)))
    with pytest.raises(FormatError, match=r"meeting\.jsonl") as error:
        check_recording(path)
    assert "\n" not in str(error.value)


@settings(deadline=None, max_examples=40)
@given(share=st.floats(0, 1))
def test_whatever_was_cut_off_the_rest_is_read(share, tmp_path_factory):
    path = tmp_path_factory.mktemp("cut") / "meeting.jsonl"
    recorder = make_recorder(path)
    ada = Person(
        **{"number": 3, "id": "0" * 16, "name": "Ada", "avatar": "plain", "visit": "", "moderator": False},
        **{
            "present": True,
            "voice": False,
            "muted": False,
            "face": "page",
            "recorded": True,
            "replayed": False,
        },
    )
    recorder.roster([ada])
    for step in range(5):
        recorder.tick(pack([(3, encode(Message(sequence=step))), (4, encode(Message()))], time_ms=0))
    recorder.close()
    whole = path.read_bytes()
    first = whole.index(b"\n") + 1
    cut = first + round(share * (len(whole) - first))
    path.write_bytes(whole[:cut])
    assert len(list(read_recording(path))) == whole[:cut].count(b"\n")
    assert [state.sequence for _, state in states(path)] == list(range(max(0, whole[:cut].count(b"\n") - 2)))


def test_a_folder_or_nothing_is_no_recording(tmp_path):
    for path in (tmp_path, tmp_path / "nothing"):
        with pytest.raises(InputError, match="no file"):
            check_recording(path)
