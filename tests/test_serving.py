"""A connection that comes in while a test's server ends is closed with it."""

import asyncio
import gc
import socket
import threading
import warnings
from contextlib import suppress

from aiohttp import web

from tests.serving import serving

SERVERS = 20
"""That end one after the other: where accepting goes on to the end, each leaves about ten sockets."""


def test_connections_of_the_last_moment_are_closed():
    async def serve_and_end() -> None:
        over = threading.Event()

        def knock(port: int) -> None:
            with suppress(OSError):  # nobody listens any more
                while not over.is_set():
                    socket.create_connection(("127.0.0.1", port)).close()

        async with serving(web.Application()) as port:
            knocking = threading.Thread(target=knock, args=[port])
            knocking.start()
            await asyncio.sleep(0.02)
        over.set()
        await asyncio.to_thread(knocking.join)

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for _ in range(SERVERS):
            asyncio.run(serve_and_end())
        gc.collect()
    assert [str(one.message) for one in caught if one.category is ResourceWarning] == []
