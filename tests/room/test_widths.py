"""The room's page at the width of a telephone, a tablet and a wide screen: nothing lies on another, or outside."""

import asyncio
import json
from itertools import combinations

import pytest

from tests.browser import Tab, chromium, needs_chromium
from tests.room.guests import open_room
from tests.room.page import come_in

pytestmark = [needs_chromium, pytest.mark.slow]

SIZES = ((360, 640), (400, 780), (800, 600), (1080, 700), (1600, 900))
NAMES = ("Bea", "Dr. Maximiliana Featherstone-Ogilvy", "W" * 40)
WORDS = {
    "#state": "Not sent: the connection is broken; press Enter again when it is back.",
    "#mark": "You are recorded",
    "#shared": "Dr. Maximiliana Featherstone-Ogilvy shares the screen",
    "#told": "ada.glb is not shown to the others: it is larger than 32 MiB, the most that is shown to others.",
}
"""What the page has to say, all at once."""
PARTS = ("#mirror", "nav", "nav > div", "#leave", "aside", "#people", "#lines", "#chat", "#replay", *WORDS)
APART = ("#mirror", "nav > div", "#leave", "aside", "#replay", *WORDS)
SLIDERS = """[...document.querySelectorAll('#people input:not([hidden])')].map(
  (slider) => slider.getBoundingClientRect().right
)"""
WALKED = """(async () => {
  const { walk } = meeting.presence, from = [walk.x, walk.z];
  const aside = document.querySelector('aside').getBoundingClientRect();
  const end = aside.width > innerWidth / 2 ? aside.top : innerHeight;
  // anywhere in the lower third of what is to be seen of the picture
  const places = Array.from({ length: 80 }, (_, i) => [i % 20 + 0.5, 0.7 + 0.07 * Math.floor(i / 20)]);
  const free = places.map(([x, y]) => [x * innerWidth / 20, y * end])
    .filter(([x, y]) => document.elementFromPoint(x, y)?.id === 'view');
  if (free.length < 10) return -1;
  const say = (kind, [x, y]) => document.querySelector('#view').dispatchEvent(
    new PointerEvent(kind, { pointerId: 1, pointerType: 'touch', buttons: 1, clientX: x, clientY: y })
  );
  HTMLElement.prototype.setPointerCapture = () => undefined;  // of a finger that is none
  say('pointerdown', free[0]); say('pointermove', [free[0][0], free[0][1] - 60]);
  walk.update(0.5);
  say('pointerup', free[0]);
  const walked = Math.hypot(walk.x - from[0], walk.z - from[1]);
  [walk.x, walk.z] = from;
  return walked;
})()"""
BOXES = """Object.fromEntries(%s.map((part) => {
  const { left, top, right, bottom } = document.querySelector(part).getBoundingClientRect();
  return [part, [left, top, right, bottom]];
}))"""

Box = tuple[float, float, float, float]
"""Left, top, right and bottom in pixels."""


async def boxes(tab: Tab, *parts: str) -> dict[str, Box]:
    return await tab.ask(BOXES % json.dumps(parts))


def inside(box: Box, width: int, height: int) -> bool:
    return 0 <= box[0] < box[2] <= width and 0 <= box[1] < box[3] <= height


def overlap(a: Box, b: Box) -> bool:
    return min(a[2], b[2]) > max(a[0], b[0]) and min(a[3], b[3]) > max(a[1], b[1])


async def observe() -> list[str]:
    """What is wrong, a sentence each."""
    wrong = []
    async with open_room() as place, chromium("--use-fake-ui-for-media-stream") as browser:
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'moderator')}"
        for name in NAMES:
            guest = await place.guest(name=name)
            await guest.say(
                kind="chat", text="A line that is longer than the list of all who are here is wide."
            )
        async with browser.open(link) as tab:
            await tab.until("document.querySelector('#join select[name=avatar]')?.value")
            for width, height in SIZES:
                await tab.look(width=width, height=height)
                door = await boxes(tab, "#join", "#join > button", "#join [name=name]")
                wrong += [
                    f"{width}: {part} at {box}"
                    for part, box in door.items()
                    if not inside(box, width, height)
                ]
            await tab.look(width=200, height=120)  # software draws the first pictures slowly
            await come_in(tab, "Ada")
            await guest.say(kind="chat", text="And one that Ada reads.")
            await tab.until("document.querySelector('#lines li')")
            await tab.ask("document.querySelector('#replay').hidden = false")  # as in a replay
            await tab.ask(
                f"Object.entries({json.dumps(WORDS)}).forEach(([part, text]) => "
                "Object.assign(document.querySelector(part), { hidden: false, textContent: text }))"
            )
            await tab.ask(f"meeting.tell({json.dumps(WORDS['#state'])})")  # or it is written over
            await tab.until("document.querySelector('#state').textContent")
            for width, height in SIZES:
                await tab.look(width=width, height=height)
                seen = await boxes(tab, *PARTS)
                wrong += [
                    f"{width}: {part} at {box}"
                    for part, box in seen.items()
                    if not inside(box, width, height)
                ]
                wrong += [
                    f"{width}: {a} on {b}" for a, b in combinations(APART, 2) if overlap(seen[a], seen[b])
                ]
                right = max(await tab.ask(SLIDERS))
                wrong += [f"{width}: a slider ends at {right}"] if right > seen["#people"][2] else []
                walked = await tab.ask(WALKED)
                wrong += [f"{width}: a finger that drags up walks {walked} m"] if walked < 0.1 else []
                lines = seen["#lines"]
                wrong += [f"{width}: no line is read"] if lines[3] - lines[1] < 40 else []
            await tab.ask("document.querySelector('#leave').click()")
            await tab.until("document.querySelector('#state').textContent.startsWith('You have left')")
            stays = await tab.ask(
                "[...document.querySelectorAll('nav, #people li')].filter((each) => each.checkVisibility()).length"
            )
            wrong += [f"{stays} things that do nothing stay behind who left"] if stays else []
    return wrong


def test_nothing_lies_on_another_or_outside():
    assert asyncio.run(observe()) == []
