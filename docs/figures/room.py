"""Draws docs/pictures/room.webp: a meeting as one of the people in it sees it, in a real browser without a camera.

And docs/pictures/room-studies.webp: what the page asks before a recorded meeting, beside the replay of that meeting.

    python docs/figures/room.py

The others are programs that send states: a smile, a word, raised brows, a gesture, hands as of a headset. Needs
Chromium, and the rig (`make rig`) for two of the people.
"""

import asyncio
import base64
import math
import sys
import tempfile
from pathlib import Path

import cv2

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(Path(__file__).parent)]

from room_page import be, come_in, draw, dressed, stand  # noqa: E402
from room_people import BLUE, PURPLE, SAND, WINE, dressed_guest, secret_of  # noqa: E402

from blender_assets.rooms.pictures import scan  # noqa: E402
from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES  # noqa: E402
from room.places import read_place  # noqa: E402
from room.recording import Recorder  # noqa: E402
from room.server.live_room import HERTZ  # noqa: E402
from tests.browser import chromium  # noqa: E402
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
    "Bea": {"at": (-0.32, -0.76), "shapes": SMILE, "flags": 2, "animation": 0, "avatar": "nora"},
    "Carl": {"at": (0.22, -0.98), "shapes": WORD, "flags": 11, "animation": 0, "avatar": "omar", **HANDS},
    "Dana": {"at": (1.5, -0.4), "shapes": WONDER, "flags": 2, "animation": 0, "avatar": "mei"},
    "Emil": {"at": (0.95, -0.92), "shapes": SMILE, "flags": 2, "animation": 5, "avatar": "leo"},
}
"""Where each stands in metres, what their face does, speaking (1), tracked (2) and hands (8), and the gesture."""

STUDIED = {
    "Bea": {
        "at": (-0.97, -0.56),
        "heading": 1.0,
        "shapes": SMILE,
        "flags": 6,
        "animation": 0,
        "avatar": "nora",
    },
    "Carl": {
        "at": (0.0, -1.12),
        "heading": 0.0,
        "shapes": WORD,
        "flags": 7,
        "animation": 0,
        "avatar": "omar",
    },
    "Dana": {
        "at": (0.97, -0.56),
        "heading": -1.0,
        "shapes": WONDER,
        "flags": 6,
        "animation": 5,
        "avatar": "nora",
    },
}
"""Who sits (4) at the far side of the table of the meeting that is recorded."""

STUDIED_FROM = (0.0, 2.5)

LOOKS_OF = {"Ada": (PURPLE, 1), "Bea": (WINE, 2), "Carl": (SAND, 0), "Dana": (BLUE, 5)}
"""Colours of clothes and of hair; the others brought theirs."""

LINES = ("Good to see you all.", "Shall we begin?", "What does the scan say?", "One question first!")

EYE = (0.75, 1.75)
LOOKS = {"heading": math.pi - 0.135, "pitch": -0.03}
"""So that everybody stands between the left edge and the list at the right, clear of the cloth at the table's head."""
SHARE = """((encoded) => {
  const content = Uint8Array.from(atob(encoded), (each) => each.charCodeAt(0));
  const file = new File([content], 'scan.jpg', { type: 'image/jpeg' });
  const carried = new DataTransfer(); carried.items.add(file);
  const input = document.querySelector('#file');
  input.files = carried.files; input.dispatchEvent(new Event('change'));
})"""
"""Puts a picture on the wall, as who looks would by "Share ..."; the words of an empty screen are cut by heads."""

STEP_S = 0.1
"""Between states: who stands still needs no more."""


async def _stay(guest: Guest, described: dict) -> None:
    """Say the same again and again; all look at who looks at them, or where they are told."""
    weights = [0.0] * len(BLENDSHAPES)
    for name, weight in described["shapes"].items():
        weights[BLENDSHAPE_INDEX[name]] = weight
    x, z = described["at"]
    state = {
        "weights": tuple(weights),
        "floor_m": (x, z),
        "heading": described.get("heading", math.atan2(EYE[0] - x, EYE[1] - z)),
        "flags": described["flags"],
        "animation": described["animation"],
        **{hand: described[hand] for hand in HANDS if hand in described},
    }
    step = 0
    while True:
        await guest.move(**state, sequence=step, time_ms=round(1000 * STEP_S) * step)
        step += 1
        await asyncio.sleep(STEP_S)


async def main() -> None:
    """Let them meet, and draw."""
    operating = {"": read_place("operating")}
    async with open_room(places=operating) as place, chromium("--use-fake-ui-for-media-stream") as browser:
        staying, guests = [], []
        for name, described in OTHERS.items():
            guest = await dressed_guest(
                place,
                name=name,
                avatar=described["avatar"],
                secret=secret_of(name, *LOOKS_OF.get(name, (0, 0))),
                moderator=name == "Carl",
            )
            staying.append(asyncio.create_task(_stay(guest, described)))
            await guest.say(kind="voice", open=True)
            guests.append(guest)
        async with browser.open(_link(place)) as tab:
            await be(tab, secret_of("Ada", *LOOKS_OF["Ada"]))
            await tab.look(width=160, height=100)
            await come_in(tab, "Ada")
            await stand(tab, x=EYE[0], z=EYE[1], **LOOKS)
            for guest, line in zip(guests, LINES, strict=True):
                await guest.say(kind="chat", text=line)
            await tab.ask(f"{SHARE}('{base64.b64encode(scan()).decode()}')")
            await tab.until("meeting.screen.board.shown")
            await dressed(tab)
            with tempfile.TemporaryDirectory() as folder:
                page = Path(folder) / "page.png"
                await draw(tab, page, **SIZE)
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
        rooms = {"": read_place("meeting")}
        async with chromium(
            "--use-fake-ui-for-media-stream", "--use-fake-device-for-media-stream"
        ) as browser:
            async with (
                open_room(recorder=recorder, places=rooms) as place,
                browser.open(_link(place)) as tab,
            ):
                staying = []
                for name, each in STUDIED.items():
                    secret = secret_of(name, *LOOKS_OF[name])
                    guest = await place.guest(name=name, recorded=True, avatar=each["avatar"], secret=secret)
                    staying.append(asyncio.create_task(_stay(guest, each)))
                await tab.look(width=520, height=880)
                await tab.until("document.querySelector('#recording').checkVisibility()", 120)
                await tab.ask("document.querySelector('#join').elements.name.value = 'Ada'")
                await asyncio.sleep(25)
                await tab.picture(Path(asked))
                for task in staying:
                    task.cancel()
            async with (
                open_room(replayed=path, places=rooms) as place,
                browser.open(_link(place)) as tab,
            ):
                await be(tab, secret_of("Ada", *LOOKS_OF["Ada"]))
                await tab.look(width=160, height=100)
                await come_in(tab, "Viewer")
                await tab.until(f"meeting.known?.size === {len(STUDIED) + 1}", 120)
                await stand(tab, x=STUDIED_FROM[0], z=STUDIED_FROM[1], heading=math.pi - 0.17, pitch=-0.12)
                await dressed(tab)
                # the page loads in the midst of a replay, or between two
                seen = "[...meeting.known.values()].every(({ figure }) => figure.root.visible)"
                await tab.until(f"meeting.replaying.time > 4 && {seen}", 240)
                await draw(tab, Path(shown), width=1280, height=880)
        both = cv2.hconcat([cv2.imread(asked), cv2.imread(shown)])
        cv2.imwrite(str(STUDIES), both, [cv2.IMWRITE_WEBP_QUALITY, 88])
        print(STUDIES.relative_to(ROOT))


if __name__ == "__main__":
    asyncio.run(main())
    asyncio.run(replayed())
