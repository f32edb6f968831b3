"""Measures what a picture of the page costs: people who move all the time, seen by one real browser.

    python benchmarks/room_page.py --people 2,8,16 --seconds 10

The others are programs that send faces, steps and gestures at 30 Hz. Counted is the time of the page's own thread for
each picture: once up to where everybody's face and body stand, and once with what WebGL is told. The last column is how
many pictures a second come of it here: without a graphics card software draws, so that it says little of a desk.
Last result: see docs/room-rights.md, with machine, versions and date. Needs Chromium.
"""

import argparse
import asyncio
import math
import statistics
import sys
from contextlib import suppress
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from room.places import read_place  # noqa: E402
from room.server.live_room import HERTZ  # noqa: E402
from tests.browser import Tab, chromium  # noqa: E402
from tests.room.guests import Guest, open_room  # noqa: E402
from tests.room.page import come_in  # noqa: E402

SIZE = {"width": 1280, "height": 720}
PATIENCE_S = 240
"""The first picture of a place takes software long."""

PICTURES = """(async (drawing, seconds) => {
  const { stage } = meeting, draw = stage.draw, took = [];
  stage.drawing = drawing;
  stage.draw = function (...all) {
    const begun = performance.now();
    draw.apply(this, all);
    took.push(performance.now() - begun);
  };
  await new Promise((over) => setTimeout(over, 1000 * seconds));
  delete stage.draw;
  stage.drawing = false;
  return took;
})"""
"""Milliseconds of each picture of some seconds."""


async def move(guest: Guest, index: int) -> None:
    """Speak, look around and walk in a small circle, until this is cancelled."""
    step = 0
    while True:
        turn = step / HERTZ + index
        await guest.move(
            weights=tuple(0.5 + 0.5 * math.sin(turn + shape) for shape in range(52)),
            floor_m=(-1.5 + 0.4 * (index % 8) + 0.2 * math.sin(turn), -1.5 - 0.6 * (index // 8)),
            heading=0.3 * math.sin(turn),
            animation=index % 3,
            flags=2,
            sequence=step % 2**16,
            time_ms=round(1000 * step / HERTZ),
        )
        step += 1
        await asyncio.sleep(1 / HERTZ)


async def measure(tab: Tab, seconds: float) -> str:
    """The columns of a row."""
    await tab.ask("void (meeting.stage.drawing = true)")
    await tab.drawn(3)  # the first one compiles shaders
    still = await tab.ask(f"{PICTURES}(false, {seconds})")
    drawn = await tab.ask(f"{PICTURES}(true, {seconds})")
    times = (
        f"{statistics.median(each):.1f}, {sorted(each)[int(0.95 * len(each))]:.1f}" for each in (still, drawn)
    )
    return f"{' | '.join(times)} | {len(drawn) / seconds:.1f}"


async def meet(people: int, *, place_name: str, seconds: float) -> str:
    """A row: so many others in one place, seen."""
    async with (
        open_room(places={"": read_place(place_name)}) as place,
        chromium("--use-fake-ui-for-media-stream") as browser,
    ):
        guests = [
            await place.guest(name=f"Bot {each}", avatar=("nora", "omar")[each % 2]) for each in range(people)
        ]
        moving = [asyncio.create_task(move(guest, index)) for index, guest in enumerate(guests)]
        async with browser.open(f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}") as tab:
            await tab.look(**SIZE)
            await come_in(tab, "Eve")
            dressed = "[...meeting.known.values()].every(({ person, figure }) => figure?.avatar.name === person.avatar)"
            await tab.until(f"meeting.known.size === {people + 1} && {dressed}", PATIENCE_S)
            found = await measure(tab, seconds)
        for task in moving:
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task
    return f"| {place_name}, {people} | {found} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--people", default="2,8,16", help="others who are seen, 2,8,16 by default")
    parser.add_argument("--place", default="operating", choices=("meeting", "operating"))
    parser.add_argument("--seconds", type=float, default=10.0, help="for each column")
    options = parser.parse_args()
    print(
        "| place, people seen | ms a picture undrawn, half and 95 % | drawn | pictures a second, by software |"
        "\n|---|---|---|---|"
    )
    for people in options.people.split(","):
        print(asyncio.run(meet(int(people), place_name=options.place, seconds=options.seconds)), flush=True)


if __name__ == "__main__":
    main()
