"""The whole way: cameras of a headset, `track run` as a person starts it, and the page in a browser."""

import asyncio
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

from tests.browser import chromium, needs_chromium

SAMPLES = Path(__file__).resolve().parents[3] / "docs/samples/headset"
CAMERAS = ("left_eye", "right_eye", "mouth")
SECONDS = 120
"""Of pictures, over and over the same hundred; the test ends before."""

pytestmark = [needs_chromium, pytest.mark.slow]


@pytest.fixture
def headset(tmp_path) -> list[str]:
    """Options of three cameras."""
    options = []
    for camera in CAMERAS:
        pictures = sorted((SAMPLES / camera).glob("*.png"))
        (tmp_path / camera).mkdir()
        own = [shutil.copy(path, tmp_path / f"{camera}-{path.name}") for path in pictures]
        for number in range(30 * SECONDS):
            os.link(own[number % len(own)], tmp_path / camera / f"{number:05d}.png")
        options += ["--camera", f"{camera}={tmp_path / camera}"]
    return options


def test_a_headset_moves_the_avatar_on_the_page(headset, tmp_path):
    command = [sys.executable, "-m", "track", "run", *headset, "--port", "0", "--no-browser"]
    told = tmp_path / "told.txt"
    with told.open("wb") as errors:
        process = subprocess.Popen([*command, "--profile", str(tmp_path / "me.toml")], stderr=errors)
    try:
        end = time.monotonic() + 60
        while not (found := re.search(r"http://127\.0\.0\.1:\d+/", told.read_text())):
            assert process.poll() is None, told.read_text()
            assert time.monotonic() < end, told.read_text()
            time.sleep(0.1)
        asyncio.run(look(found[0], tmp_path / "page.png", psutil.Process(process.pid)))
        assert process.poll() is None, told.read_text()
    finally:
        process.terminate()
        process.wait(20)


def sockets(process: psutil.Process) -> set[tuple[str, int]]:
    """Own ends of all that a process and its children have open, and the other ends."""
    ends = set()
    for each in (process, *process.children(recursive=True)):
        for connection in each.net_connections(kind="inet"):
            ends |= {tuple(end) for end in (connection.laddr, connection.raddr) if end}
    return ends


async def look(address: str, picture: Path, process: psutil.Process) -> None:
    """The avatar moves, three pictures come, the page says that all is live, and nothing goes anywhere else."""
    async with chromium() as browser, browser.open(address) as tab:
        await tab.look(width=500, height=400)
        await tab.until("globalThis.track?.stage.avatar && connection.dataset.state === 'live'", 60)
        await tab.until("document.querySelectorAll('#cameras canvas').length === 3")
        seen = []
        for _ in range(6):
            seen.append(await tab.ask("Object.values(track.stage.avatar.influences())"))
            hosts = {host for host, _ in sockets(process)}
            assert hosts == {"127.0.0.1"}
            await asyncio.sleep(0.5)
        moved = [max(values) - min(values) for values in zip(*seen, strict=True)]
        assert max(moved) > 0.05
        await tab.until("Number(fps.textContent) > 5")
        await tab.picture(picture)
        assert tab.complaints == []
