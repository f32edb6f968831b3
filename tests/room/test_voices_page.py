"""Two pages of two servers hear each other by a real Janus, and again after it was killed."""

import asyncio
from contextlib import AsyncExitStack
from pathlib import Path

import pytest

from room.server import new_keys
from room.server.janus import Janus
from room.server.redis_channels import RedisChannels
from tests.browser import chromium, needs_chromium
from tests.room.bare_place import BARE
from tests.room.engines import API_SECRET, free_port, janus, needs_janus, needs_redis, redis
from tests.room.guests import open_room
from tests.room.page import AWAKE, come_in
from tests.room.speech import SILENT_S, VOICED_S, write_bursts

pytestmark = [needs_chromium, needs_janus, needs_redis, pytest.mark.slow]

LOUD = (
    "[...meeting.voice.sounds].some("
    "([id, sound]) => meeting.voice.state(id) === 'connected' && sound.peak() > 0.01)"
)
"""Whether somebody is heard: bursts of speech reach .3, and a line without sound is 0."""

STATE = "document.querySelector('#state').textContent"

SENT = """(async () => {
  const stats = await meeting.voice.lines.up.getStats();
  return [...stats.values()].filter(({ type }) => type === 'outbound-rtp').length;
})()"""


LISTEN = """void (() => {
  const at = () => performance.now();
  globalThis.loudAt = at();
  setInterval(() => {
    for (const sound of meeting.voice.sounds.values()) if (sound.peak() > 0.001) globalThis.loudAt = at();
  }, 40);
})()"""
"""Keeps when anything came last, before the page's own volume."""

SILENT = f"performance.now() - loudAt > {1000 * (VOICED_S + SILENT_S) + 200}"
"""Speech begins anew in this time."""


async def talk(folder: Path) -> dict[str, object]:
    """Two people by two servers, Redis and Janus, which is killed under them."""
    write_bursts(folder / "speech.wav")
    keys, wire, engine = new_keys(), free_port(), free_port()
    async with AsyncExitStack() as stack:
        stack.enter_context(redis(wire))
        first = stack.enter_context(janus(engine, folder))
        places = []
        for _ in range(2):
            channels = RedisChannels(f"redis://127.0.0.1:{wire}/0", secret=keys.secret)
            engines = [Janus(f"ws://127.0.0.1:{engine}", secret=API_SECRET)]
            opened = open_room(keys=keys, channels=channels, engines=engines, places=BARE)
            places.append(await stack.enter_async_context(opened))
        sound = f"--use-file-for-fake-audio-capture={folder / 'speech.wav'}"
        browser = await stack.enter_async_context(chromium(*AWAKE, sound))
        tabs = []
        for place, name in zip(places, ("Ada", "Ben"), strict=True):
            link = f"{place.address}/room/meeting#{keys.key('meeting', 'guest')}"
            tabs.append(await stack.enter_async_context(browser.open(link)))
            await come_in(tabs[-1], name)
        for tab in tabs:
            await tab.until("meeting.known.size === 2")
        for tab in tabs:
            await tab.until(LOUD)
        found: dict[str, object] = {"lines up": await tabs[0].ask(SENT)}
        chair = await places[0].guest(name="Chair", moderator=True)
        ada = next(person.number for person in chair.welcome.people if person.name == "Ada")
        await chair.say(kind="moderate", action="mute", number=ada)
        await tabs[1].ask(LISTEN)
        await tabs[1].until(SILENT)  # Janus itself passes on nothing of who is muted
        await tabs[0].until(LOUD)
        await chair.say(kind="moderate", action="unmute", number=ada)
        first.kill()
        for tab in tabs:
            await tab.until(f"{STATE}.includes('Voices are interrupted')")
        found["silent"] = [await tab.ask("meeting.voice.sounds.size") for tab in tabs]
        stack.enter_context(janus(engine, folder))
        for tab in tabs:
            await tab.until(LOUD)
        found["words"] = [await tab.ask(STATE) for tab in tabs]
        found["complaints"] = [complaint for tab in tabs for complaint in tab.complaints]
        return found


def test_two_servers_people_hear_each_other_by_janus_also_after_it_was_killed(tmp_path):
    found = asyncio.run(talk(tmp_path))
    print(found)
    assert found["lines up"] == 1, "one voice goes up, however many hear it"
    assert found["silent"] == [0, 0]
    assert found["words"] == ["", ""]
    assert found["complaints"] == []
