"""A connection that comes in just before a test's server ends is closed with it."""

import asyncio
import gc
import socket
import warnings

import pytest
from aiohttp import web

from tests.serving import end


@pytest.mark.parametrize("turns", range(4))
def test_a_connection_of_the_last_moment_is_closed(turns: int):
    async def serve_and_end() -> None:
        runner = web.AppRunner(web.Application(), shutdown_timeout=0.1)
        await runner.setup()
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        client = socket.create_connection(runner.addresses[0])
        try:
            for _ in range(turns):
                await asyncio.sleep(0)
            await end(runner)
        finally:
            client.close()

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        asyncio.run(serve_and_end())
        gc.collect()
    assert [str(one.message) for one in caught if one.category is ResourceWarning] == []
