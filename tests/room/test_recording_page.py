"""The page of a recorded room asks before it comes in, and that of a replay says that it is one."""

import asyncio
import json
from pathlib import Path

import pytest

from room.protocol import decode
from room.recording import Recorder, read_recording
from room.recording.lines import Came, Gone, Tick
from room.server.hall import HERTZ
from tests.browser import chromium, needs_chromium
from tests.room.guests import Place, open_room
from tests.room.test_page import AWAKE, come_in

pytestmark = [needs_chromium, pytest.mark.slow]

SEEN = "!!document.querySelector('%s')?.checkVisibility()"
MARK = "document.querySelector('#mark')"


def link(place: Place) -> str:
    return f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"


def answer(value: str) -> str:
    return f"void (document.querySelector('#recording input[value={value}]').checked = true)"


def test_consent_is_asked_before_and_a_replay_moves_as_recorded(tmp_path):
    path = tmp_path / "meeting.jsonl"

    async def run() -> None:
        async with chromium(*AWAKE) as browser:
            await record(browser)
            await replay(browser)

    async def record(browser) -> None:
        recorder = Recorder(path, room="meeting", hertz=HERTZ, ended=pytest.fail)
        async with open_room(recorder=recorder) as place, browser.open(link(place)) as tab:
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
            await asyncio.sleep(1.5)
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
        states = [decode(state) for line in lines if isinstance(line, Tick) for _, state in line.states]
        assert len(states) > 20
        async with open_room(replayed=path) as place, browser.open(link(place)) as tab:
            await tab.until(SEEN % "#replayed")
            assert not await tab.ask(SEEN % "#recording")
            await come_in(tab, "Viewer")
            await tab.until(f"{MARK}.textContent === 'Replay' && {SEEN % '#mark'}")
            # between two rounds nobody is there
            await tab.until(
                "[...meeting.known.values()].some(({ person, newest }) => person.replayed && newest)"
            )
            seen = "[...meeting.known.values()].find(({ person }) => person.replayed)?.newest?.floor_m"
            floor = json.loads(await tab.ask(f"JSON.stringify(Array.from({seen} ?? []))"))
            assert tuple(floor) in {state.floor_m for state in states}
            away = f"Math.hypot(meeting.presence.walk.x - {floor[0]}, meeting.presence.walk.z - {floor[1]}) > 0.69"
            await tab.until(f"meeting.presence.placed && {away}")
            assert "replay" in await tab.ask("document.querySelector('#people').textContent")
            assert await tab.ask("meeting.voice.lines.peers.size") == 0, "nobody calls who cannot answer"
            await tab.ask("void (meeting.stage.drawing = true)")
            await tab.look(width=960, height=600)
            await asyncio.sleep(1.0)
            await tab.picture(tmp_path / "replay.png")
            assert not tab.complaints

    asyncio.run(run())
    assert Path(path).exists()
