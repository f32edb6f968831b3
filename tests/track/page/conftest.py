"""One browser for all tests of the page, and a stand for each."""

import asyncio
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.browser import Browser, chromium
from tests.track.page.heads import head
from tests.track.page.stand import Stand, standing


@pytest.fixture(scope="package")
def loop() -> Iterator[asyncio.AbstractEventLoop]:
    loop = asyncio.new_event_loop()
    yield loop
    loop.close()


@pytest.fixture(scope="package")
def browser(loop) -> Iterator[Browser]:
    context = chromium()
    yield loop.run_until_complete(context.__aenter__())
    loop.run_until_complete(context.__aexit__(None, None, None))


@pytest.fixture(scope="package")
def egg(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("avatars") / "egg.glb"
    path.write_bytes(head())
    return path


@pytest.fixture
def stand(loop, browser, egg) -> Iterator[Stand]:
    context = standing(browser, egg)
    yield loop.run_until_complete(context.__aenter__())
    loop.run_until_complete(context.__aexit__(None, None, None))
