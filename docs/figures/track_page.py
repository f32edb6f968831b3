"""Draws docs/pictures/track-page.jpg: the page of track in a real browser.

    python docs/figures/track_page.py

The picture has `track run` twice: a film of NASA's portrait of Eileen Collins that sways (tests/track/pictures), and
on a telephone's screen the sample of a headset. Needs Chromium; MediaPipe's model file is fetched where it is not there
yet.
"""

import asyncio
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.browser import chromium  # noqa: E402
from tests.track.faces import film_of, moving  # noqa: E402
from tests.track.page.running import headset, running  # noqa: E402

PICTURES = ROOT / "docs/pictures"
SECONDS = 240
"""Of film, of which a browser without a graphics card needs some to draw its first picture."""
GAP, PAPER = 40, (255, 255, 255)

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


if __name__ == "__main__":
    still().save(PICTURES / "track-page.jpg", quality=88)
