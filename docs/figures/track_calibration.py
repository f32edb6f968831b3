"""Draws docs/pictures/track-calibration.jpg: what the page of track asks for while it learns a face.

    python docs/figures/track_calibration.py

A network camera plays the sample's actor (docs/samples/acting-avatar.webm), who makes the face that is asked for: the
film's frame in which that shape is largest. Three moments on a telephone's screen stand side by side. Needs Chromium;
MediaPipe's model file is fetched where it is not there yet.
"""

import asyncio
import csv
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.browser import Tab, chromium  # noqa: E402
from tests.track.mjpeg_server import MjpegServer, mjpeg_server  # noqa: E402
from tests.track.page.running import running  # noqa: E402

SAMPLE = ROOT / "docs/samples/acting-avatar"
PICTURE = ROOT / "docs/pictures/track-calibration.jpg"
MADE_BY = {
    "Jaw open": "jawOpen",
    "Smile": "mouthSmileLeft",
    "Brows up": "browInnerUp",
    "Pucker": "mouthPucker",
}
"""Faces that are asked for, and the shape of the film's frame that shows each."""
MOMENTS = ("Neutral · Get ready", "Neutral · Hold it", "Jaw open · Hold it")
GAP = 30
LIVE = """globalThis.track?.stage.avatar && connection.dataset.state === "live"
    && document.querySelector("#cameras canvas")"""


class Actor:
    """Frames of the film: that of the face that is made now, under a sensor's noise."""

    def __init__(self) -> None:
        film = cv2.VideoCapture(f"{SAMPLE}.webm")
        self._frames = []
        while (read := film.read())[0]:
            self._frames.append(read[1])
        rows = list(csv.DictReader(Path(f"{SAMPLE}.csv").read_text().splitlines()))
        self._of = {
            face: int(np.argmax([float(row[shape]) for row in rows])) for face, shape in MADE_BY.items()
        }
        self._noise, self.face = np.random.default_rng(0), ""

    def picture(self, number: int) -> np.ndarray:
        """What the camera sees now."""
        frame = self._frames[self._of.get(self.face, 0)]
        return np.clip(frame + self._noise.normal(0, 1, frame.shape), 0, 255).astype(np.uint8)


async def moments(address: str, actor: Actor, folder: Path) -> list[Image.Image]:
    """The page at each of `MOMENTS`."""
    found: dict[str, Path] = {}
    async with chromium() as browser, browser.open(address) as tab:
        await tab.look(width=400, height=800, telephone=True)
        await tab.until(LIVE, 90)
        await asyncio.sleep(5)
        await tab.ask("document.querySelector('#calibrate button').click(), 1")
        async with asyncio.timeout(120):
            while len(found) < len(MOMENTS):
                asked = await asked_for(tab)
                actor.face = asked.split(" · ")[0]
                if asked in MOMENTS and asked not in found:
                    await asyncio.sleep(0.7)  # the avatar follows
                    found[asked] = folder / f"{len(found)}.png"
                    await tab.picture(found[asked])
                await asyncio.sleep(0.05)
    return [Image.open(found[moment]).convert("RGB") for moment in MOMENTS]


async def asked_for(tab: Tab) -> str:
    """The face that is asked for, and how far it is; nothing where none is."""
    return str(
        await tab.ask(
            "document.getElementById('asking').hidden ? '' : document.getElementById('asking-name').textContent"
        )
    )


def main() -> None:
    actor = Actor()
    camera = MjpegServer(picture=actor.picture)
    with tempfile.TemporaryDirectory() as folder, mjpeg_server(camera):
        options = ["--camera", f"http://127.0.0.1:{camera.port}/stream"]
        with running(Path(folder), options) as (address, _):
            pages = asyncio.run(moments(address, actor, Path(folder)))
    width = sum(page.width + GAP for page in pages) - GAP
    together = Image.new("RGB", (width, pages[0].height), "white")
    for number, page in enumerate(pages):
        together.paste(page, (number * (page.width + GAP), 0))
    together.save(PICTURE, quality=88)


if __name__ == "__main__":
    main()
