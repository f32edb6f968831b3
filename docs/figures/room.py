"""Draws docs/pictures/room.webp: a meeting as one of the people in it sees it, in a real browser without a camera.

And docs/pictures/room-studies.webp: what the page asks before a recorded meeting, beside the replay of that meeting.

    python docs/figures/room.py

The others are programs that send states: a smile, a word, raised brows, a gesture, hands as of a headset. Needs
Chromium, and the rig (`make rig`) for two of the people.
"""

import asyncio
import math
import sys
import tempfile
from pathlib import Path

import cv2

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(Path(__file__).parent)]

from room_page import come_in, dressed, stand  # noqa: E402
from room_people import dressed_guest  # noqa: E402

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES  # noqa: E402
from room.places import read_place  # noqa: E402
from room.recording import Recorder  # noqa: E402
from room.server.hall import HERTZ  # noqa: E402
from tests.browser import Tab, chromium  # noqa: E402
from tests.room.guests import Guest, Place, open_room  # noqa: E402

OUT = ROOT / "docs/pictures/room.webp"
STUDIES = ROOT / "docs/pictures/room-studies.webp"
SIZE = {"width": 1280, "height": 800}

SMILE = {"mouthSmileLeft": 0.8, "mouthSmileRight": 0.8, "cheekSquintLeft": 0.5, "cheekSquintRight": 0.5}
WORD = {"jawOpen": 0.35, "mouthFunnel": 0.3, "browInnerUp": 0.3}
WONDER = {
    "browInnerUp": 0.8,
    "browOuterUpLeft": 0.8,
    "browOuterUpRight": 0.8,
    "eyeWideLeft": 0.5,
    "eyeWideRight": 0.5,
}

HALF = math.sqrt(0.5)
HANDS = {
    "left_hand": (0.15, 1.2, 0.3, 0.0, 0.0, -HALF, HALF),
    "right_hand": (-0.21, 1.13, 0.33, 0.0, 0.0, HALF, HALF),
}
"""Held out, thumbs up, as of somebody who explains."""

OTHERS = {
    "Bea": {"at": (-0.47, -0.74), "shapes": SMILE, "flags": 2, "animation": 0, "avatar": "nora"},
    "Carl": {"at": (-0.01, -0.98), "shapes": WORD, "flags": 11, "animation": 0, "avatar": "omar", **HANDS},
    "Dana": {"at": (0.5, -0.72), "shapes": WONDER, "flags": 2, "animation": 0, "avatar": "mei"},
    "Emil": {"at": (0.95, -0.86), "shapes": SMILE, "flags": 2, "animation": 5, "avatar": "leo"},
}
"""Where each stands in metres, what their face does, speaking (1), tracked (2) and hands (8), and the gesture."""

LINES = ("Good to see you all.", "Shall we begin?", "What does the scan say?", "One question first!")

EYE = (0.37, 0.9)
LOOKS = {"heading": math.pi - 0.08, "pitch": -0.045}


async def _stay(guest: Guest, described: dict) -> None:
    """Thirty times a second, as a page does; all look at who looks at them."""
    weights = [0.0] * len(BLENDSHAPES)
    for name, weight in described["shapes"].items():
        weights[BLENDSHAPE_INDEX[name]] = weight
    x, z = described["at"]
    state = {
        "weights": tuple(weights),
        "floor_m": (x, z),
        "heading": math.atan2(EYE[0] - x, EYE[1] - z),
        "flags": described["flags"],
        "animation": described["animation"],
        **{hand: described[hand] for hand in HANDS if hand in described},
    }
    step = 0
    while True:
        await guest.move(**state, sequence=step, time_ms=33 * step)
        step += 1
        await asyncio.sleep(1 / 30)


async def settle(tab: Tab) -> None:
    """Wait until arms and faces are where they go; the window is small, as software draws slowly."""
    await tab.ask(
        "void (globalThis.drawn = 0, (function next() { drawn++; requestAnimationFrame(next); })())"
    )
    await tab.until("drawn >= 30", 240)


async def main() -> None:
    """Let them meet, and draw."""
    operating = {"": read_place("operating")}
    async with open_room(places=operating) as place, chromium("--use-fake-ui-for-media-stream") as browser:
        staying, guests = [], []
        for name, described in OTHERS.items():
            guest = await dressed_guest(
                place, name=name, avatar=described["avatar"], moderator=name == "Carl"
            )
            staying.append(asyncio.create_task(_stay(guest, described)))
            await guest.say(kind="voice", open=True)
            guests.append(guest)
        async with browser.open(_link(place)) as tab:
            await tab.look(width=320, height=200)
            await come_in(tab, "Ada")
            await stand(tab, x=EYE[0], z=EYE[1], **LOOKS)
            for guest, line in zip(guests, LINES, strict=True):
                await guest.say(kind="chat", text=line)
            await dressed(tab)
            await settle(tab)
            await tab.look(**SIZE)
            await tab.ask("void (drawn = 0)")
            await tab.until("drawn >= 3", 240)
            with tempfile.TemporaryDirectory() as folder:
                page = Path(folder) / "page.png"
                await tab.picture(page)
                cv2.imwrite(str(OUT), cv2.imread(str(page)), [cv2.IMWRITE_WEBP_QUALITY, 88])
            print(f"{OUT.relative_to(ROOT)}; complaints: {tab.complaints}")
        for task in staying:
            task.cancel()


def _link(place: Place) -> str:
    return f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"


async def replayed() -> None:
    """Record them for half a minute, and draw the question and the replay."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "meeting.jsonl"
        asked, shown = (str(Path(folder) / name) for name in ("asked.png", "shown.png"))
        recorder = Recorder(path, room="meeting", hertz=HERTZ, ended=sys.exit)
        async with chromium(
            "--use-fake-ui-for-media-stream", "--use-fake-device-for-media-stream"
        ) as browser:
            async with open_room(recorder=recorder) as place, browser.open(_link(place)) as tab:
                staying = [
                    asyncio.create_task(
                        _stay(await place.guest(name=name, recorded=True, avatar=each["avatar"]), each)
                    )
                    for name, each in OTHERS.items()
                ]
                await tab.look(width=520, height=880)
                await tab.until("document.querySelector('#recording').checkVisibility()")
                await tab.ask("document.querySelector('#join').elements.name.value = 'Ada'")
                await asyncio.sleep(25)
                await tab.picture(Path(asked))
                for task in staying:
                    task.cancel()
            async with open_room(replayed=path) as place, browser.open(_link(place)) as tab:
                await tab.look(width=1080, height=880)
                await tab.until("document.querySelector('#join select[name=avatar]')?.value")
                await tab.ask(
                    "(() => { const form = document.querySelector('#join'); form.elements.name.value = 'Viewer';"
                    " if (form.elements.voice.checked) form.elements.voice.click(); form.requestSubmit(); })()"
                )
                await tab.until(f"meeting.known?.size === {len(OTHERS) + 1}", 30)
                looking = f"{{ x: {EYE[0]}, z: {EYE[1] + 0.7}, heading: Math.PI - 0.2, pitch: -0.05 }}"
                await tab.until("meeting.placed")
                await tab.ask(f"void Object.assign(meeting.walk, {looking})")
                await asyncio.sleep(8)
                await tab.picture(Path(shown))
        both = cv2.hconcat([cv2.imread(asked), cv2.imread(shown)])
        cv2.imwrite(str(STUDIES), both, [cv2.IMWRITE_WEBP_QUALITY, 88])
        print(STUDIES.relative_to(ROOT))


if __name__ == "__main__":
    asyncio.run(main())
    asyncio.run(replayed())
