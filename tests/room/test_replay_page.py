"""A replay is halted, moved along and slowed by the page's bar and by keys; its people stand as they stood."""

import asyncio
from pathlib import Path

import pytest

from room.protocol import decode
from room.recording import read_recording
from room.recording.lines import Tick
from tests.browser import Tab, chromium, needs_chromium
from tests.room.guests import open_room
from tests.room.recordings import make_recorder
from tests.room.test_page import AWAKE, come_in

pytestmark = [needs_chromium, pytest.mark.slow]

PRESS = "document.body.dispatchEvent(new KeyboardEvent('keydown', { key: '%s', bubbles: true, cancelable: true }))"
SLIDE = """(() => {
  const slider = document.querySelector('#moment');
  slider.value = %s;
  slider.dispatchEvent(new Event('change'));
})()"""
SHOWN = (
    "[...meeting.known.values()].filter(({ person, newest }) => person.replayed && newest)"
    ".map(({ playback }) => playback.at(performance.now()).heading)[0]"
)
PLAYING = "meeting.replaying.playing"


async def recorded(path: Path) -> None:
    """Somebody who turns for six seconds, by an eighth of a radian each second."""
    async with open_room(recorder=make_recorder(path)) as place:
        ada = await place.guest(recorded=True)
        clock = asyncio.get_running_loop().time
        begun = clock()
        while (time_s := clock() - begun) < 6:
            await ada.move(sequence=round(time_s * 1000), time_ms=round(time_s * 1000), heading=time_s / 8)
            await asyncio.sleep(1 / 30)


async def watched(tab: Tab) -> dict[str, object]:
    await come_in(tab, "Viewer")
    await tab.until("document.querySelector('#replay').checkVisibility()")
    await tab.ask(PRESS % " ")
    await tab.until(f"{PLAYING}.paused && document.querySelector('#halt').textContent === 'Play'")
    await tab.ask(SLIDE % 3)
    await tab.until(f"{PLAYING}.time_s === 3 && Math.abs({SHOWN} - 0.375) < 0.03")
    await asyncio.sleep(2.0)
    found: dict[str, object] = {
        "held": await tab.ask(SHOWN),
        "clock": await tab.ask("document.querySelector('#clock').textContent"),
    }
    await tab.ask(PRESS % "l")
    await tab.until(f"{PLAYING}.time_s > 5")
    await tab.ask(PRESS % "j")
    await tab.until(f"{PLAYING}.time_s < 2")
    await tab.ask(PRESS % "Home")
    for speed in (0.5, 0.25):
        await tab.ask(PRESS % "<")
        await tab.until(f"{PLAYING}.speed === {speed}")
    await tab.until(f"{PLAYING}.speed === 0.25 && {PLAYING}.time_s === 0")
    await tab.ask("document.querySelector('#halt').click()")
    await tab.until(f"!{PLAYING}.paused && {SHOWN} > 0.06")
    turned, at = await tab.ask(f"[{SHOWN}, performance.now()]")
    await asyncio.sleep(3.0)
    later, then = await tab.ask(f"[{SHOWN}, performance.now()]")
    found["pace"] = (later - turned) / (then - at) * 1000
    found["complaints"] = tab.complaints
    return found


def test_a_replay_is_halted_moved_along_and_slowed(tmp_path):
    path = tmp_path / "meeting.jsonl"

    async def run() -> dict[str, object]:
        await recorded(path)
        async with chromium(*AWAKE) as browser, open_room(replayed=path) as place:
            async with browser.open(
                f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            ) as tab:
                return await watched(tab)

    found = asyncio.run(asyncio.wait_for(run(), 120))
    print(found)
    ticks = [line for line in read_recording(path) if isinstance(line, Tick)]
    rate = [decode(tick.states[0][1]).heading for tick in (ticks[0], ticks[-1])]
    pace = (rate[1] - rate[0]) / (ticks[-1].time_ms - ticks[0].time_ms) * 1000
    assert found["held"] == pytest.approx(3 * pace, abs=0.02), "two seconds later nobody has sunk or gone on"
    assert found["clock"].startswith("0:03 / 0:0")
    assert found["pace"] == pytest.approx(pace / 4, rel=0.4), (
        "not a half; a busy machine shows late what came late"
    )
    assert found["complaints"] == []
