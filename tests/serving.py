"""A server within a test, which leaves no socket to the garbage collector.

pytest makes an error of the collector's warning, of whichever test runs then: seen twice in ten runs of all tests.
"""

import asyncio
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from ssl import SSLContext

from aiohttp import web

_TURNS = 3
"""A socket that was accepted becomes a connection of the server within two turns of the loop."""


@asynccontextmanager
async def serving(
    app: web.Application, port: int = 0, certified: SSLContext | None = None
) -> AsyncIterator[int]:
    """Serve on this machine, on a free port unless one is named; gives the port.

    Where asyncio's server closes between accepting a socket and wrapping it, nobody closes the socket [1]_: so none is
    accepted any more some turns before. What waits for a client that does not read is cut, not flushed.

    References
    ----------
    .. [1] https://github.com/python/cpython/issues/109564
    """
    runner = web.AppRunner(app, access_log=None, shutdown_timeout=0.1)
    await runner.setup()
    listener = socket.create_server(("127.0.0.1", port))
    await web.SockSite(runner, listener, ssl_context=certified).start()
    try:
        yield listener.getsockname()[1]
    finally:
        asyncio.get_running_loop().remove_reader(listener)
        await _turn()
        connections = [handler.transport for handler in runner.server.connections]
        await runner.cleanup()
        for transport in filter(None, connections):
            transport.abort()
        await _turn()


async def _turn() -> None:
    for _ in range(_TURNS):
        await asyncio.sleep(0)
