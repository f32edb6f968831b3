"""A recorded room over real WebSockets: who is in the file, and what a killed server or a full disk leaves."""

import asyncio
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import aiohttp
import pytest

from room.errors import FormatError
from room.protocol import Message, encode
from room.protocol.answers import Changed, Notice
from room.protocol.tick import pack
from room.recording import check_recording, read_recording
from room.recording.lines import Came, Gone, Heading, Tick
from room.recording.writer import MOST_WAITING
from tests.room.guests import SOON_S, Guest, Place, open_room
from tests.room.recordings import make_recorder, states, walk

ROOT = Path(__file__).resolve().parents[2]


def test_only_who_agreed_is_in_the_file_and_everybody_sees_who_that_is(tmp_path):
    path = tmp_path / "meeting.jsonl"

    async def run() -> None:
        recorder = make_recorder(path)
        async with open_room(recorder=recorder) as place:
            async with place.session.get(f"{place.address}/room/meeting/about.json") as answer:
                assert await answer.json() == {"recording": recorder.id, "replay": False, "engine": False}
            async with place.session.get(f"{place.address}/room/other/about.json") as answer:
                assert await answer.json() == {"recording": "", "replay": False, "engine": False}
            chair = await place.guest(moderator=True, name="Chair")
            ada = await place.guest(recorded=True)
            ben = await place.guest(name="Ben Declines")
            assert ben.welcome.recording == recorder.id
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

    async def run() -> tuple[int, int]:
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
            return ada.number, ben.number

    ada, ben = asyncio.run(run())
    assert {(number, state.animation) for number, state in states(path)} == {(ada, 0), (ben, 6)}
    kinds = [type(line) for line in read_recording(path) if not isinstance(line, Tick)]
    assert kinds == [Heading, Came, Gone, Came, Gone]


@pytest.mark.parametrize("agreed", ["", "0" * 16])
def test_who_agreed_to_another_recording_is_not_in_this_one(agreed, tmp_path):
    """As a page that comes back by itself after the server was started with a new file."""

    async def run() -> None:
        async with open_room(recorder=make_recorder(tmp_path / "second.jsonl")) as place:
            ada = await place.guest(recorded=True, recording=agreed)
            assert not ada.welcome.people[0].recorded
            await ada.say(kind="consent", recorded=True)
            assert (await ada.told(Changed, lambda told: told.person.recorded)).person.number == ada.number

    asyncio.run(run())


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
    monkeypatch.setattr(recorder, "_put", lambda file, line: stalled.wait(120))

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
            assert time.monotonic() - start < 60
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
            about = await (await session.get(f"{address}/about.json")).json()
            join = {"kind": "join", "key": key, "secret": "s" * 22, "name": "Ada"}
            await socket.send_json(join | {"recorded": True, "recording": about["recording"]})
            guest = Guest(socket, "")
            await walk(guest, steps=30)
            await guest.until(lambda: any(sequence == 29 for _, sequence in guest.sequences))
            async with asyncio.timeout(SOON_S):  # the thread that writes has its turn
                while len(states(path)) < 30:
                    await asyncio.sleep(0.05)
            run.kill()
            await guest.reading
            return len(guest.sequences)

    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as run:
        try:
            link = run.stdout.readline().split("\t")[2].strip()
            assert asyncio.run(meet(*link.split("#"))) == 30
        finally:
            run.kill()
    assert [state.sequence for _, state in states(path)] == list(range(30))
    assert path.stat().st_mode & 0o077 == 0
    before = path.read_bytes()
    for name in ("meeting-2.jsonl", "meeting-3.jsonl"):  # as when a supervisor starts it again
        with subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
        ) as again:
            again.stdout.readline()
            again.terminate()
            _, said = again.communicate(timeout=300)
        assert again.returncode == 0
        assert f"goes to {tmp_path / name}" in said
        assert path.with_name(name).stat().st_size
    assert path.read_bytes() == before
