"""The page before the room, in a real browser: nobody is heard who did not want to be."""

import asyncio

import pytest

from tests.browser import chromium, needs_chromium
from tests.room.bare_place import BARE
from tests.room.guests import open_room
from tests.room.page import AWAKE, UNDRAWN, come_in

ASKED = """void (() => {
  const devices = navigator.mediaDevices;
  const give = devices.getUserMedia.bind(devices);
  globalThis.given = [];
  const answered = new Promise((resolve) => (globalThis.answer = resolve));
  devices.getUserMedia = async (wish) => {
    await answered;
    const stream = await give(wish);
    given.push(stream);
    return stream;
  };
})()"""
"""From now on the browser's question for a microphone stands until the page's `answer` is called."""

TICK = "document.querySelector('#join [name=voice]').click()"
COME_IN = """(() => {
  const form = document.querySelector('#join');
  form.elements.name.value = 'Ada';
  form.requestSubmit();
})()"""


@pytest.mark.slow
@needs_chromium
@pytest.mark.parametrize("unticked_first", [True, False])
def test_who_unticks_the_microphone_while_the_browser_asks_comes_in_without(unticked_first):
    async def run() -> dict[str, object]:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await tab.until("document.querySelector('#join select[name=avatar]')?.value")
                await tab.ask(UNDRAWN)
                await tab.ask(ASKED)
                await tab.ask(TICK)
                await tab.ask(TICK)  # asks anew
                for act in (TICK, COME_IN) if unticked_first else (COME_IN, TICK):
                    await tab.ask(act)
                await tab.until("globalThis.meeting?.own")
                await tab.ask("answer()")
                await tab.until(
                    "given.length === 1 && given[0].getTracks().every((each) => each.readyState === 'ended')"
                )
                return await tab.ask(
                    "[meeting.microphone === undefined, document.querySelector('#mute').textContent]"
                )

    assert asyncio.run(run()) == [True, "No microphone"]


PLUGGED = """void ((devices) => {
  const list = devices.enumerateDevices.bind(devices);
  const other = { kind: 'audioinput', deviceId: 'other', groupId: '', label: 'Another one' };
  devices.enumerateDevices = async () => [other, ...(await list())];
  devices.dispatchEvent(new Event('devicechange'));
})(navigator.mediaDevices)"""
"""Another microphone comes, and the system lists it first."""


@pytest.mark.slow
@needs_chromium
def test_the_list_of_microphones_names_the_one_in_use_also_when_another_comes():
    async def run() -> list[str]:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                named = "document.querySelector('#join [name=microphone]')?.selectedOptions[0]?.text"
                await tab.until(named)
                before = await tab.ask(named)
                await tab.ask(PLUGGED)
                await tab.until(
                    "document.querySelector('#join [name=microphone]').options[0].text === 'Another one'"
                )
                return [before, await tab.ask(named)]

    before, after = asyncio.run(run())
    assert after == before != "Another one"


@pytest.mark.slow
@needs_chromium
def test_a_copy_of_a_tab_is_somebody_else_and_a_tab_that_is_loaded_again_is_not():
    secret = "sessionStorage.getItem('secret of meeting')"

    async def run() -> list[object]:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as first, browser.open(link) as copy:
                await come_in(first, "Ada")
                before = await first.ask(secret)
                await copy.ask(f"sessionStorage.setItem('secret of meeting', '{before}')")
                await come_in(copy, "Ada again")
                copied = await copy.ask(secret)
                await first.until("meeting.known.size === 2")
                await first.ask("void (globalThis.earlier = true)")
                await first.call("Page.reload")
                await first.until("!globalThis.earlier")
                await come_in(first, "Ada")
                again = await first.ask(secret)
                return [copied == before, again == before, await first.ask("meeting.known.size")]

    assert asyncio.run(run()) == [False, True, 2]
