"""A page's server, what it was asked for, and a tab that looks at it, for the tests of the page in a browser."""

import asyncio
import time
from contextlib import asynccontextmanager
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.runtime.features.reference_shape import load_reference_shape
from regress.runtime.sample import Sample
from tests.browser import Browser, Tab
from track.messages import Command, Moment
from track.page import Page

STEPS = ("neutral", "jaw_open", "smile")

SOON_S = 120.0
"""What is awaited comes in a tenth of a second; a slow machine with other work is given time."""


class Stand:
    """A page's server and what it was asked for, a tab that looks at it, and words for both."""

    def __init__(self, page: Page, asked: list[Command], tab: Tab) -> None:
        self.page, self.asked, self.tab = page, asked, tab
        self._read = 0

    async def show(self, weights: np.ndarray, **changes: object) -> dict[str, float]:
        """Publish until the avatar stands at these weights, and give what it stands at."""
        moment = moment_of(weights, **changes)
        end = time.monotonic() + SOON_S
        while True:
            self.page.publish(moment)
            await asyncio.sleep(0.05)
            stands = await self.tab.ask("track.stage.avatar?.influences()") or {}
            if stands and max(abs(stands[name] - told(weights, name)) for name in stands) <= 0.001:
                return stands
            assert time.monotonic() < end, (stands, self.tab.complaints)

    async def publish_until(self, script: str, **changes: object) -> None:
        """Publish a face at rest until an expression in the page is true."""
        end = time.monotonic() + SOON_S
        while not await self.tab.ask(f"Boolean({script})"):
            self.page.publish(moment_of(np.zeros(52), **changes))
            await asyncio.sleep(0.05)
            assert time.monotonic() < end, f"{script} stays false; complaints: {self.tab.complaints}"

    async def drop(self, path: Path) -> None:
        """Drop a file onto the avatar, as a hand does."""
        data = {"items": [], "files": [str(path)], "dragOperationsMask": 1}
        for kind in ("dragEnter", "dragOver", "drop"):
            await self.tab.call("Input.dispatchDragEvent", type=kind, x=200, y=200, data=data)

    async def asks(self, count: int) -> list[Command]:
        """The next so many commands to the session, once they are there."""
        end = time.monotonic() + SOON_S
        while len(self.asked) < self._read + count:
            await asyncio.sleep(0.01)
            assert time.monotonic() < end, self.asked[self._read :]
        self._read += count
        return self.asked[self._read - count : self._read]


def told(weights: np.ndarray, name: str) -> float:
    """A weight as an avatar applies it: 0 where nothing is known."""
    return float(np.nan_to_num(weights[BLENDSHAPES.index(name)]))


def moment_of(weights: np.ndarray, *, pictures: bool = True, **changes: object) -> Moment:
    shape = load_reference_shape().points[:, :2] * [1, -1]
    points = (shape - shape.mean(0)) / np.ptp(shape[:, 0]) * 60 + [80, 60]
    sample = {"time_s": 0.0, "weights": weights}
    sample |= {key: changes.pop(key) for key in ("gaze", "head") if key in changes}
    shown = {"camera": np.full((120, 160, 3), 128, np.uint8)} if pictures else {}
    return Moment(sample=Sample(**sample), pictures=shown, points={"camera": points}, **changes)


@asynccontextmanager
async def standing(browser: Browser, avatar: Path, *, quiet: bool = True):
    """A page with an avatar on its stage, which speaks to nobody else; with `quiet` also without a complaint."""
    asked: list[Command] = []
    with Page(asked.append, steps=STEPS, avatar=avatar) as page:
        async with browser.open(page.url) as tab:
            await tab.look(width=400, height=300)  # drawn in software, sixty times a second
            await tab.until("globalThis.track?.stage.avatar && document.querySelector('#step').length")
            yield Stand(page, asked, tab)
            assert {urlsplit(address).hostname for address in tab.asked if ":" in address} <= {
                "127.0.0.1",
                None,
            }
            if quiet:
                assert tab.complaints == []
