"""Draws docs/pictures/room-places.webp: the operating room and the meeting room with people, as the page shows them.

    python docs/figures/room_places.py

The people are programs. Needs Chromium; a minute or two without a graphics card.
"""

import asyncio
import math
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from facegen.conventions import BLENDSHAPES  # noqa: E402
from room.places import read_place  # noqa: E402
from tests.browser import chromium  # noqa: E402
from tests.room.guests import open_room  # noqa: E402

STANDING, SITTING, POINTING = (0, 2), (0, 6), (7, 2)
"""Animation and flags of the state message."""
SMILE = tuple(0.5 if name.startswith("mouthSmile") else 0.0 for name in BLENDSHAPES)
VIEWS = {
    "operating": (
        "{ x: 0.3, z: 2.3, heading: Math.PI - 0.03, pitch: -0.05 }",
        (
            ("Bea", "nora", (0.05, -0.78), 0.0, STANDING),
            ("Carl", "omar", (0.75, 0.78), math.pi, POINTING),
            ("Dana", "nora", (-1.42, 0.05), math.pi / 2, STANDING),
        ),
    ),
    "meeting": (
        "{ x: 1.2, z: 2.4, heading: Math.PI + 0.35, pitch: -0.08 }",
        (
            ("Bea", "nora", (0.0, -1.12), 0.0, SITTING),
            ("Carl", "omar", (0.97, -0.56), -1.0, SITTING),
            ("Dana", "nora", (-1.9, -1.5), 1.2, POINTING),
        ),
    ),
}
JOIN = """(() => {
    const form = document.querySelector("#join");
    form.elements.name.value = "Ada";
    if (form.elements.voice.checked) form.elements.voice.click();
    form.requestSubmit();
})()"""
COUNT = "void (globalThis.drawn = 0, (function next() { drawn++; requestAnimationFrame(next); })())"


async def stay(guest, floor_m: tuple[float, float], heading: float, doing: tuple[int, int]) -> None:
    """Say the same state again and again."""
    number = 0
    while True:
        await guest.move(
            weights=SMILE,
            floor_m=floor_m,
            heading=heading,
            animation=doing[0],
            flags=doing[1],
            sequence=number,
            time_ms=33 * number,
        )
        number += 1
        await asyncio.sleep(0.2)


async def picture_of(name: str) -> Image.Image:
    """A place, 1600 x 900 pixels, as somebody sees it who has just come in."""
    stand, people = VIEWS[name]
    browsing = chromium("--use-fake-ui-for-media-stream")
    async with open_room(places={"": read_place(name)}) as place, browsing as browser:
        tasks = []
        for who, avatar, floor_m, heading, doing in people:
            guest = await place.guest(name=who, avatar=avatar)
            tasks.append(asyncio.create_task(stay(guest, floor_m, heading, doing)))
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        async with browser.open(link) as tab:
            await tab.look(width=1600, height=900)
            await tab.until("document.querySelector('#join select[name=avatar]')?.value", 60)
            await tab.ask(JOIN)
            await tab.until("globalThis.meeting?.placed", 60)
            everybody = "[...meeting.known.values()].every(({ figure }) => figure.avatar.name !== 'plain')"
            await tab.until(everybody, 180)
            await tab.ask(f"void Object.assign(meeting.walk, {stand})")
            await tab.ask(COUNT)
            await tab.until("drawn >= 12", 120)
            with tempfile.TemporaryDirectory() as folder:
                await tab.picture(Path(folder, "page.png"))
                seen = Image.open(Path(folder, "page.png")).convert("RGB")
        for task in tasks:
            task.cancel()
    return seen


def main() -> None:
    """Draw both places, one above the other."""
    pages = [asyncio.run(picture_of(name)).resize((1000, 562), Image.Resampling.LANCZOS) for name in VIEWS]
    both = Image.new("RGB", (1000, 2 * 562 + 8), (255, 255, 255))
    for number, page in enumerate(pages):
        both.paste(page, (0, number * 570))
    both.save(ROOT / "docs/pictures/room-places.webp", quality=82, method=6)


if __name__ == "__main__":
    main()
