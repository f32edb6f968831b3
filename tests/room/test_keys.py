"""Keys in a real browser: arrows open lists before these do anything, and a key that is held is pressed once."""

import asyncio

import pytest

from tests.browser import Tab, needs_chromium
from tests.room.page import meet

DONE = """(() => {{
  const list = document.querySelector('{}');
  globalThis.done = [];
  list.addEventListener('change', () => globalThis.done.push(list.value), true);
  list.focus();
}})()"""


KEYS = {"ArrowDown": 40, "ArrowUp": 38, "End": 35, "Enter": 13, "Escape": 27}


async def press(tab: Tab, key: str) -> None:
    for kind in ("keyDown", "keyUp"):
        await tab.call(
            "Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=KEYS[key]
        )


@pytest.mark.slow
@needs_chromium
@pytest.mark.parametrize("chosen", ["#share", "#gesture"])
def test_arrows_open_a_list_and_enter_chooses(tmp_path, chosen):
    async def run() -> dict[str, object]:
        async with meet(tmp_path, "Ada") as (_, (tab,)):
            await tab.ask(DONE.format(chosen))
            found = {}
            for key in ("ArrowDown", "End"):
                await press(tab, key)
                await tab.until(f"document.querySelector('{chosen}').matches(':open')")
                found[key] = await tab.ask("globalThis.done")
                await press(tab, "Escape")
                await tab.until(f"!document.querySelector('{chosen}').matches(':open')")
            await press(tab, "ArrowDown")
            await tab.until(f"document.querySelector('{chosen}').matches(':open')")
            await press(tab, "End")
            await press(tab, "Enter")
            await tab.until("globalThis.done.length")
            found["Enter"] = await tab.ask("globalThis.done")
            return found

    found = asyncio.run(run())
    assert found["ArrowDown"] == found["End"] == []
    assert len(found["Enter"]) == 1


HOLD = """[false, true, true, true].map((repeat) => {
  dispatchEvent(new KeyboardEvent('keydown', { key: '5', code: 'Digit5', repeat }));
  return meeting.presence.stance.animation;
})"""


@pytest.mark.slow
@needs_chromium
def test_a_gestures_key_that_is_held_counts_once_and_again_ends_it(tmp_path):
    async def run() -> list[object]:
        async with meet(tmp_path, "Ada") as (_, (tab,)):
            return [await tab.ask(HOLD), await tab.ask(HOLD)]

    assert asyncio.run(run()) == [[5] * 4, [0] * 4]
