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
sys.path[:0] = [str(ROOT), str(Path(__file__).parent)]

from room_page import be, come_in, draw, dressed, stand  # noqa: E402
from room_people import BLUE, PURPLE, SAND, WINE, secret_of  # noqa: E402

from facegen.conventions import BLENDSHAPES  # noqa: E402
from room.places import read_place  # noqa: E402
from tests.browser import chromium  # noqa: E402
from tests.room.guests import open_room  # noqa: E402

STANDING, SITTING, POINTING = (0, 2), (0, 6), (7, 2)
"""Animation and flags of the state message."""
SMILE = tuple(0.5 if name.startswith("mouthSmile") else 0.0 for name in BLENDSHAPES)
SIZE = {"width": 1280, "height": 720}
VIEWS = {
    "operating": (
        {"x": -0.1, "z": 2.9, "heading": math.pi - 0.17, "pitch": -0.05},
        (
            ("Bea", "nora", (0.05, -0.78), 0.0, STANDING),
            ("Carl", "omar", (0.75, 0.78), math.pi, POINTING),
            ("Dana", "nora", (-1.42, 0.05), math.pi / 2, STANDING),
        ),
    ),
    "meeting": (
        {"x": 1.2, "z": 2.4, "heading": math.pi + 0.31, "pitch": -0.08},
        (
            ("Bea", "nora", (0.0, -1.12), 0.0, SITTING),
            ("Carl", "omar", (0.97, -0.56), -1.0, SITTING),
            ("Dana", "nora", (-1.9, -1.5), 1.2, POINTING),
        ),
    ),
}
"""Where who looks stands, so that nobody is cut off or below the list at the right; then the others."""

COLOURED = {"Ada": (PURPLE, 1), "Bea": (WINE, 2), "Carl": (SAND, 0), "Dana": (BLUE, 5)}
"""Colours of clothes and of hair."""


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
    """A place, as somebody sees it who has just come in."""
    view, people = VIEWS[name]
    browsing = chromium("--use-fake-ui-for-media-stream")
    async with open_room(places={"": read_place(name)}) as place, browsing as browser:
        tasks = []
        for who, avatar, floor_m, heading, doing in people:
            guest = await place.guest(name=who, avatar=avatar, secret=secret_of(who, *COLOURED[who]))
            tasks.append(asyncio.create_task(stay(guest, floor_m, heading, doing)))
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        async with browser.open(link) as tab:
            await be(tab, secret_of("Ada", *COLOURED["Ada"]))
            await tab.look(width=160, height=100)
            await come_in(tab, "Ada")
            await stand(tab, **view)
            await dressed(tab)
            with tempfile.TemporaryDirectory() as folder:
                await draw(tab, Path(folder, "page.png"), **SIZE)
                seen = Image.open(Path(folder, "page.png")).convert("RGB")
        for task in tasks:
            task.cancel()
    return seen


def main() -> None:
    """Draw both places, one above the other."""
    pages = [asyncio.run(picture_of(name)) for name in VIEWS]
    width, height = pages[0].size
    both = Image.new("RGB", (width, 2 * height + 8), (255, 255, 255))
    for number, page in enumerate(pages):
        both.paste(page, (0, number * (height + 8)))
    both.save(ROOT / "docs/pictures/room-places.webp", quality=82, method=6)


if __name__ == "__main__":
    main()
