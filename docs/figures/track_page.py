"""Draws docs/pictures/track-page.jpg and track-page.webp: the page of track in a real browser.

    python docs/figures/track_page.py

The picture has `track run` twice: a film of NASA's portrait of Eileen Collins that sways (tests/track/pictures), and
on a telephone's screen the sample of a headset. The animation has that sample once more, with the weights that come
with it. Needs Chromium; MediaPipe's model file is fetched where it is not there yet.
"""

import asyncio
import csv
import sys
import tempfile
import time
from pathlib import Path

import cv2
import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from facegen.conventions import BLENDSHAPES  # noqa: E402
from regress.runtime.sample import Sample  # noqa: E402
from tests.browser import Tab, chromium  # noqa: E402
from tests.track.faces import film_of, moving  # noqa: E402
from tests.track.page.running import CAMERAS, SAMPLES, headset, running  # noqa: E402
from track.messages import Moment  # noqa: E402
from track.page import Page  # noqa: E402

PICTURES = ROOT / "docs/pictures"
SECONDS = 240
"""Of film, of which a browser without a graphics card needs some to draw its first picture."""
GAP, PAPER = 40, (255, 255, 255)
ANIMATED, STEP = (960, 540), 2
"""Pixels of the animation, and every which of the sample's 30 frames a second it shows."""

LIVE = """globalThis.track?.stage.avatar && connection.dataset.state === "live"
    && document.querySelector("#cameras canvas")"""


async def picture_of(address: str, **window: object) -> Image.Image:
    """The page behind some seconds of life."""
    with tempfile.TemporaryDirectory() as folder:
        async with chromium() as browser, browser.open(address) as tab:
            await tab.look(**window)
            await tab.until(LIVE, 90)
            await asyncio.sleep(8)
            await tab.picture(Path(folder, "page.png"))
        return Image.open(Path(folder, "page.png")).convert("RGB")


def still() -> Image.Image:
    """A wide page beside a telephone's."""
    pages = []
    with tempfile.TemporaryDirectory() as folder:
        film = film_of(Path(folder, "film.avi"), moving(120) * (30 * SECONDS // 120))
        with running(Path(folder), ["--camera", str(film)]) as (address, _):
            pages.append(asyncio.run(picture_of(address, width=1600, height=900)))
    with tempfile.TemporaryDirectory() as folder:
        with running(Path(folder), headset(Path(folder), seconds=SECONDS)) as (address, _):
            window = {"width": 400, "height": 900, "dark": True, "telephone": True}
            pages.append(asyncio.run(picture_of(address, **window)))
    both = Image.new("RGB", (sum(page.width for page in pages) + GAP, 900), PAPER)
    both.paste(pages[0], (0, 0))
    both.paste(pages[1], (pages[0].width + GAP, 0))
    return both


async def film() -> list[Image.Image]:
    """Pages of the sample, each behind its own weights."""
    with (SAMPLES.parent / "headset.weights.csv").open(newline="") as rows:
        weights = [np.array([float(row[name]) for name in BLENDSHAPES]) for row in csv.DictReader(rows)]
    with Page(lambda command: None, cameras=CAMERAS) as page, tempfile.TemporaryDirectory() as folder:
        async with chromium() as browser, browser.open(page.url) as tab:
            await tab.look(width=ANIMATED[0], height=ANIMATED[1])
            await tab.until("globalThis.track?.stage.avatar", 90)
            images = []
            for number in range(0, len(weights), STEP):
                await show(page, tab, number, weights[number])
                await tab.picture(Path(folder, "page.png"))
                images.append(Image.open(Path(folder, "page.png")).convert("RGB"))
            return images


async def show(page: Page, tab: Tab, number: int, weights: np.ndarray) -> None:
    """Publish a frame of the sample until the page stands at it."""
    seen = {
        name: cv2.imread(str(SAMPLES / name / f"{number:03d}.png"), cv2.IMREAD_GRAYSCALE) for name in CAMERAS
    }
    moment = Moment(sample=Sample(time_s=number / 30, weights=weights), pictures=seen, fps=30.0)
    jaw = BLENDSHAPES.index("jawOpen")
    end = time.monotonic() + 60
    for _ in range(4):  # pictures come fifteen times a second at most
        page.publish(moment)
        await asyncio.sleep(0.1)
    while abs(await tab.ask("track.stage.avatar.influences().jawOpen") - weights[jaw]) > 0.001:
        assert time.monotonic() < end
        page.publish(moment)
        await asyncio.sleep(0.1)


if __name__ == "__main__":
    still().save(PICTURES / "track-page.jpg", quality=88)
    first, *others = asyncio.run(film())
    first.save(
        PICTURES / "track-page.webp",
        save_all=True,
        append_images=others,
        duration=1000 * STEP // 30,
        loop=0,
        quality=60,
        method=6,
    )
