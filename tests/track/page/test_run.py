"""The whole way: cameras, `track run` as a person starts it, and the page in a browser."""

import asyncio

import psutil
import pytest

from tests.browser import chromium, needs_chromium
from tests.track.faces import film_of, moving
from tests.track.page.running import headset, running

pytestmark = [needs_chromium, pytest.mark.slow]


def hosts(number: int) -> set[str]:
    """Both ends of all sockets that a process and its children have open."""
    process, ends = psutil.Process(number), set()
    for each in (process, *process.children(recursive=True)):
        for connection in each.net_connections(kind="inet"):
            ends |= {end.ip for end in (connection.laddr, connection.raddr) if end}
    return ends


async def look(address: str, process: int, *, cameras: int, moved: str) -> None:
    """The avatar moves, pictures come, the page says that all is live, and nothing goes anywhere else."""
    async with chromium() as browser, browser.open(address) as tab:
        await tab.look(width=500, height=400)
        await tab.until("globalThis.track?.stage.avatar && connection.dataset.state === 'live'")
        await tab.until(f"document.querySelectorAll('#cameras canvas').length === {cameras}")
        await tab.ask(f"void (globalThis.before = {moved})")
        await tab.until(f"{moved}.some((value, at) => Math.abs(value - before[at]) > 0.05)")
        assert hosts(process) == {"127.0.0.1"}
        await tab.until("Number(fps.textContent) > 0")
        assert tab.complaints == []


def test_a_headset_moves_the_avatar_on_the_page(tmp_path):
    with running(tmp_path, [*headset(tmp_path, seconds=3), "--loop"]) as (address, process):
        weights = "Object.values(track.stage.avatar.influences())"
        asyncio.run(look(address, process, cameras=3, moved=weights))


def test_a_film_of_a_real_face_turns_the_avatars_head(tmp_path, detector_file):
    film = film_of(tmp_path / "film.avi", moving(120))
    options = ["--camera", str(film), "--loop", "--detector-file", str(detector_file)]
    with running(tmp_path, options) as (address, process):
        head = "track.stage.avatar.model.getObjectByProperty('isBone', true).getObjectByName('Head')"
        turned = f"({head} ?? track.stage.avatar.model.getObjectByName('Neck')).quaternion.toArray()"
        asyncio.run(look(address, process, cameras=1, moved=turned))
