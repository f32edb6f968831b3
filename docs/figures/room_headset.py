"""Draws docs/pictures/room-headset.jpg: three cameras of a headset, and the face in the room that they move.

    python docs/figures/room_headset.py

`track` runs as a process of its own on the films of docs/samples/headset: first on the rest at their beginning, for the
neutral face, and then on the whole of them. Pictures come slower than they were filmed, so that a machine with other
work leaves none out. Needs Chromium.
"""

import asyncio
import shutil
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(Path(__file__).parent)]

from room_page import come_in, only_the_room, stand  # noqa: E402

from tests.browser import chromium  # noqa: E402
from tests.room.guests import open_room  # noqa: E402

OUT = ROOT / "docs/pictures/room-headset.jpg"
FILMS = ROOT / "docs/samples/headset"
CAMERAS = ("left_eye", "right_eye", "mouth")
FRAMES = (8, 34, 73, 92)
"""At rest, a funnel, a pucker, shut eyes."""
SIZE = 360
REST = 10
"""Frames at the beginning of the films."""
RATE = ("--fps", "5")

KEEP = """(() => {
  const kept = [];
  const { playback } = %s;
  playback.push = (message) => void (message.flags & 2 && kept.push(message));
  const before = { ...meeting.presence.sent, floor_m: [0, -2.2], heading: 0, head_m: [0, 0, 0] };
  playback.at = () => globalThis.held ?? kept.at(-1) ?? before;
  const off = (each, sequence) => Math.abs(each.sequence - sequence);
  globalThis.nearest = (sequence) => [...kept].sort((a, b) => off(a, sequence) - off(b, sequence))[0];
})()"""
"""Keeps what comes, to be drawn afterwards: software draws slower than the face moves."""


async def run_track(*words: str) -> None:
    """Run `track` to its end."""
    track = await asyncio.create_subprocess_exec(sys.executable, "-m", "track", *words, cwd=ROOT)
    if await track.wait():
        raise SystemExit("track did not end well")


def cameras(films: Path) -> list[str]:
    """The options that name the three films of a folder."""
    return [word for name in CAMERAS for word in ("--camera", f"{name}={films / name}")]


def write_rest(films: Path) -> None:
    """Films of half a minute of rest."""
    for name in CAMERAS:
        (films / name).mkdir(parents=True)
        for frame in range(150):
            shutil.copy(FILMS / name / f"{frame % REST:03}.png", films / name / f"{frame:03}.png")


async def shown(folder: Path) -> list[np.ndarray]:
    """The face in the room at each frame, BGR."""
    profile = ("--profile", str(folder / "ada.toml"))
    write_rest(folder / "rest")
    await run_track("calibrate", "neutral", *cameras(folder / "rest"), *profile, *RATE)
    async with open_room() as place, chromium("--use-fake-ui-for-media-stream") as browser:
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        ada = await place.guest(name="Ada", avatar="nora")
        await ada.move(floor_m=(0.0, -2.2))
        async with browser.open(link) as tab:
            await tab.look(width=SIZE, height=SIZE)
            await come_in(tab, "Eve")
            await only_the_room(tab)
            await stand(tab, x=0.0, z=-1.68, heading=np.pi, pitch=-0.1)
            face = "[...meeting.known.values()].find(({ person }) => person.name === 'Ada')"
            await tab.until(f"{face}?.figure.avatar.name === 'nora'", 60)
            await tab.ask(KEEP % face)
            options = ("--no-page", "--to", f"room:{link}.{ada.secret}")
            await run_track(*cameras(FILMS), *profile, *RATE, *options)
            pictures = []
            for frame in FRAMES:
                await tab.ask(f"void (globalThis.held = nearest({frame + 1}))")
                await asyncio.sleep(2)
                path = folder / f"{frame}.png"
                await tab.picture(path)
                pictures.append(cv2.imread(str(path)))
                print(f"frame {frame}: state {await tab.ask('held.sequence')}", file=sys.stderr)
            print(f"complaints: {tab.complaints}", file=sys.stderr)
            return pictures


def main() -> None:
    """Cameras above, the room below, a column for each moment."""
    with tempfile.TemporaryDirectory() as folder:
        rooms = asyncio.run(shown(Path(folder)))
    columns = []
    for frame, room in zip(FRAMES, rooms, strict=True):
        views = [cv2.imread(str(FILMS / name / f"{frame:03}.png")) for name in CAMERAS]
        strip = cv2.resize(cv2.hconcat(views), (SIZE, SIZE // 3), interpolation=cv2.INTER_CUBIC)
        columns.append(
            cv2.copyMakeBorder(cv2.vconcat([strip, room]), 0, 0, 3, 3, cv2.BORDER_CONSTANT, value=(255,) * 3)
        )
    cv2.imwrite(str(OUT), cv2.hconcat(columns), [cv2.IMWRITE_JPEG_QUALITY, 85])
    print(f"{OUT.relative_to(ROOT)}: {OUT.stat().st_size // 1000} kB")


if __name__ == "__main__":
    main()
