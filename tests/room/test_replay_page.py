"""A replay is halted, moved along and slowed by the page's bar and by keys; its people stand as they stood."""

import asyncio
from collections.abc import Iterator

import pytest

from room.protocol import Message
from room.server.live_room import HERTZ
from tests.browser import Tab, chromium, needs_chromium
from tests.room.bare_place import BARE
from tests.room.guests import open_room
from tests.room.page import AWAKE, come_in
from tests.room.recordings import write_recording

pytestmark = [needs_chromium, pytest.mark.slow]

PRESS = "document.body.dispatchEvent(new KeyboardEvent('keydown', { key: '%s', bubbles: true, cancelable: true }))"
SLIDE = """(() => {
  const slider = document.querySelector('#moment');
  slider.value = %s;
  slider.dispatchEvent(new Event('change'));
})()"""
HELD = """(() => {
  const { replaying } = meeting, { say } = replaying, slider = document.querySelector('#moment');
  let asked = 0;
  replaying.say = (said) => { asked++; say(said); };
  const press = (target, key) =>
    target.dispatchEvent(new KeyboardEvent('keydown', { key, repeat: true, bubbles: true, cancelable: true }));
  for (let i = 0; i < 30; i++) press(document.body, 'l');
  const byLetter = asked;
  slider.focus();
  for (let i = 1; i <= 30; i++) {
    press(slider, 'ArrowRight');
    slider.value = i / 10;
    for (const kind of ['input', 'change']) slider.dispatchEvent(new Event(kind));
  }
  replaying.say = say;
  const focused = document.activeElement === slider;
  slider.blur();
  return [byLetter, asked - byLetter, focused, slider.valueAsNumber];
})()"""
"""What a held key asks for, on the page and on the slider; whether that keeps the focus, and where it stands then."""
SHOWN = (
    "[...meeting.known.values()].filter(({ person, newest }) => person.replayed && newest)"
    ".map(({ playback }) => playback.at(performance.now()).heading)[0]"
)
NEWEST = (
    "[...meeting.known.values()].filter(({ person, newest }) => person.replayed && newest)"
    ".map(({ newest: { heading, time_ms } }) => [heading, time_ms])[0]"
)
PLAYING = "meeting.replaying.playing"

PACE = 1 / 8
"""Of who turns, in radians a second."""


def turning(seconds: int) -> Iterator[Message]:
    """What somebody says who turns evenly."""
    for step in range(HERTZ * seconds):
        time_s = step / HERTZ
        yield Message(sequence=step, time_ms=round(1000 * time_s), heading=PACE * time_s)


async def watched(tab: Tab) -> dict[str, object]:
    await come_in(tab, "Viewer")
    await tab.until("document.querySelector('#replay').checkVisibility()")
    await tab.ask(PRESS % " ")
    await tab.until(f"{PLAYING}.paused && document.querySelector('#halt').textContent === 'Play'")
    await tab.ask(SLIDE % 3)
    await tab.until(f"{PLAYING}.time_s === 3 && Math.abs({SHOWN} - {3 * PACE}) < 0.01")
    await asyncio.sleep(2.0)
    found: dict[str, object] = {
        "held": await tab.ask(SHOWN),
        "clock": await tab.ask("document.querySelector('#clock').textContent"),
    }
    await tab.ask(PRESS % "l")
    await tab.until(f"{PLAYING}.time_s > 5")
    await tab.ask(PRESS % "j")
    await tab.until(f"{PLAYING}.time_s < 2")
    await asyncio.sleep(1.0)
    found["held keys"] = await tab.ask(HELD)
    await tab.until(f"{PLAYING}.time_s === 3")
    await tab.ask(PRESS % "Home")
    for speed in (0.5, 0.25):
        await tab.ask(PRESS % "<")
        await tab.until(f"{PLAYING}.speed === {speed}")
    await tab.until(f"{PLAYING}.speed === 0.25 && {PLAYING}.time_s === 0 && Math.abs({SHOWN}) < 0.01")
    await tab.ask("document.querySelector('#halt').click()")
    await tab.until(f"!{PLAYING}.paused && {SHOWN} > 0.02")
    turned, at_ms = await tab.ask(NEWEST)
    await tab.until(f"{SHOWN} > {turned} + 0.06")
    later, then_ms = await tab.ask(NEWEST)
    found["pace"] = (later - turned) / (then_ms - at_ms) * 1000
    found["complaints"] = tab.complaints
    return found


def test_a_replay_is_halted_moved_along_and_slowed(tmp_path):
    path = write_recording(tmp_path / "meeting.jsonl", turning(6))

    async def run() -> dict[str, object]:
        async with chromium(*AWAKE) as browser, open_room(replayed=path, places=BARE) as place:
            async with browser.open(
                f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            ) as tab:
                return await watched(tab)

    found = asyncio.run(asyncio.wait_for(run(), 1200))
    print(found)
    assert found["held"] == pytest.approx(3 * PACE, abs=0.01), "two seconds later nobody has sunk or gone on"
    assert found["clock"].startswith("0:03 / 0:0")
    assert found["held keys"] == [1, 0, True, 3], (
        "one jump, and the slider's last moment a quarter of a second later"
    )
    assert found["pace"] == pytest.approx(PACE / 4, rel=0.1), "not a half"
    assert found["complaints"] == []
