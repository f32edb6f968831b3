"""The page of a recorded room asks before it comes in, and that of a replay says that it is one."""

import asyncio
from contextlib import AsyncExitStack
from pathlib import Path

import pytest

from room.recording import Recorder, read_recording
from room.recording.lines import Came, Gone
from room.server import new_keys
from room.server.live_room import HERTZ
from tests.browser import chromium, needs_chromium
from tests.room.bare_place import BARE
from tests.room.engines import free_port
from tests.room.guests import SOON_S, Place, open_room
from tests.room.page import AWAKE, come_in
from tests.room.recordings import states

pytestmark = [needs_chromium, pytest.mark.slow]

SEEN = "!!document.querySelector('%s')?.checkVisibility()"
MARK = "document.querySelector('#mark')"

STATES = 20
"""More are in the recording: two thirds of a second of a quick page."""


def link(place: Place) -> str:
    return f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"


def answer(value: str) -> str:
    return f"void (document.querySelector('#recording input[value={value}]').checked = true)"


def test_there_is_nothing_to_agree_to_once_a_recording_has_ended(tmp_path):
    ended: list[str] = []
    recorder = Recorder(
        tmp_path / "meeting.jsonl", room="meeting", hertz=HERTZ, ended=ended.append, most_bytes=30_000
    )

    async def run() -> None:
        async with (
            chromium(*AWAKE) as browser,
            open_room(recorder=recorder, places=BARE) as place,
            browser.open(link(place)) as tab,
        ):
            await tab.until(SEEN % "#recording")
            await tab.ask(answer("yes"))
            await come_in(tab, "Ada")
            await tab.until(SEEN % "#consent")
            await tab.until(f"!({SEEN % '#consent'})")
            assert ended
            assert not await tab.ask(SEEN % "#mark")

    asyncio.run(run())


def test_consent_is_asked_before_and_a_replay_moves_as_recorded(tmp_path):
    path = tmp_path / "meeting.jsonl"

    async def run() -> None:
        async with chromium(*AWAKE) as browser:
            await record(browser)
            await replay(browser)

    async def record(browser) -> None:
        recorder = Recorder(path, room="meeting", hertz=HERTZ, ended=pytest.fail)
        async with open_room(recorder=recorder, places=BARE) as place, browser.open(link(place)) as tab:
            await tab.until(SEEN % "#recording")
            assert not await tab.ask(SEEN % "#replayed")
            await tab.ask("document.querySelector('#join').elements.name.value = 'Ada'")
            await tab.ask("document.querySelector('#join').requestSubmit()")
            await asyncio.sleep(0.5)
            assert await tab.ask("!globalThis.meeting.own && !document.querySelector('#join').hidden"), (
                "no answer yet"
            )
            await tab.ask(answer("yes"))
            await come_in(tab, "Ada")
            await tab.until(f"{MARK}.textContent === 'You are recorded' && {SEEN % '#mark'}")
            assert "recorded" in await tab.ask("document.querySelector('#people').textContent")
            async with asyncio.timeout(SOON_S):
                while len(states(path)) <= STATES:
                    await asyncio.sleep(0.05)
            await tab.ask("document.querySelector('#consent').click()")
            await tab.until(f"!({SEEN % '#mark'})")
            assert await tab.ask("document.querySelector('#consent').textContent") == "Agree to be recorded"
            async with browser.open(link(place)) as other:
                await other.until(SEEN % "#recording")
                await other.ask(answer("no"))
                await other.ask("void sessionStorage.clear()")
                await come_in(other, "Ben")
                await other.until("meeting.known.size === 2")
                assert not await other.ask(SEEN % "#mark")

    async def replay(browser) -> None:
        lines = list(read_recording(path))
        assert [line.name for line in lines if isinstance(line, Came)] == ["Ada"]
        assert any(isinstance(line, Gone) for line in lines)
        assert len(states(path)) > STATES
        async with open_room(replayed=path) as place, browser.open(link(place)) as tab:
            await tab.until(SEEN % "#replayed")
            assert not await tab.ask(SEEN % "#recording")
            await come_in(tab, "Viewer")
            await tab.until(f"{MARK}.textContent === 'Replay' && {SEEN % '#mark'}")
            seen = "[...meeting.known.values()].find(({ person }) => person.replayed)?.newest?.floor_m"
            await tab.until(f"(globalThis.stood = {seen})")  # between two rounds nobody is there
            floor = await tab.ask("Array.from(stood)")
            assert tuple(floor) in {state.floor_m for _, state in states(path)}
            away = f"Math.hypot(meeting.presence.walk.x - {floor[0]}, meeting.presence.walk.z - {floor[1]}) > 0.69"
            await tab.until(f"meeting.presence.placed && {away}")
            await tab.until("document.querySelector('#people').textContent.includes('replay')")
            assert await tab.ask("meeting.voice.lines.peers.size") == 0, "nobody calls who cannot answer"
            await tab.look(width=320, height=240)
            await tab.ask("void (meeting.stage.drawing = true)")
            await tab.drawn(3)
            assert not tab.complaints

    asyncio.run(run())
    assert Path(path).exists()


def test_a_yes_is_asked_for_anew_where_another_recording_begins(tmp_path):
    """The page comes back by itself, and must not carry the first yes into a second file."""
    keys, port = new_keys(), free_port()

    def served(name: str):
        recorder = Recorder(tmp_path / name, room="meeting", hertz=HERTZ, ended=pytest.fail)
        return open_room(recorder=recorder, places=BARE, keys=keys, port=port)

    async def run() -> None:
        async with AsyncExitStack() as stack:
            browser = await stack.enter_async_context(chromium(*AWAKE))
            async with served("first.jsonl") as place:
                tab = await stack.enter_async_context(browser.open(link(place)))
                await tab.until(SEEN % "#recording")
                await tab.ask(answer("yes"))
                await come_in(tab, "Ada")
                await tab.until(f"{MARK}.textContent === 'You are recorded' && {SEEN % '#mark'}")
                first = await tab.ask("meeting.own.recording")
            async with served("second.jsonl"):
                await tab.until(f"meeting.own.recording !== '{first}' && meeting.known.size === 1")
                await tab.until(f"!({SEEN % '#mark'})")
                assert (
                    await tab.ask("document.querySelector('#consent').textContent") == "Agree to be recorded"
                )
                await tab.ask("document.querySelector('#consent').click()")
                await tab.until(SEEN % "#mark")

    asyncio.run(run())
