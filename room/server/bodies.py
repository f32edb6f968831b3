"""Sends what is large in pieces, as fast as it is taken: who asks for many files and reads nothing takes no memory."""

import asyncio
from collections.abc import Awaitable, Callable, Coroutine
from typing import Any
from weakref import WeakValueDictionary

from aiohttp import web

from room.server.limits import MOST_BODIES
from room.server.pending_connections import PendingConnections

PIECE_BYTES = 64 * 1024
"""Written at once; the next piece goes once the network has taken nearly all. What is smaller goes whole."""

SLOWEST_BYTES_PER_S = 16 * 1024
"""Whose network takes less of all its bodies together is cut: a meeting needs ten times as much. One of six files that
share a slow link takes a sixth of it, and would else be cut and asked for again without end."""

PATIENCE_S = 30.0
"""Beside that: a telephone's change of networks takes ten seconds."""

_LOOK_S = 0.05
"""Between looks whether the last piece has gone."""


class _Network:
    """How much the people of one network have taken while bodies went there."""

    def __init__(self) -> None:
        self.taken_bytes = 0


class Bodies:
    """The large answers on their way from a server.

    With more than `room.server.limits.MOST_BODIES` the oldest of the network that most of them go to is cut.
    """

    def __init__(self) -> None:
        self._going = PendingConnections(most=MOST_BODIES)
        self._networks: WeakValueDictionary[str, _Network] = WeakValueDictionary()

    @web.middleware
    async def pace(
        self, request: web.Request, handler: Callable[[web.Request], Awaitable[web.StreamResponse]]
    ) -> web.StreamResponse:
        """Send a large answer, and cut who takes it too slowly: a middleware of the application."""
        answer = await handler(request)
        body = answer.body if isinstance(answer, web.Response) else None
        transport = request.transport
        if (
            not isinstance(body, bytes)
            or len(body) <= PIECE_BYTES
            or request.method == "HEAD"
            or transport is None
        ):
            return answer
        going = self._going.add(request.remote, transport.abort)
        network = self._networks.setdefault(going.origin, _Network())
        response = web.StreamResponse(status=answer.status, headers=answer.headers)
        response.content_length = len(body)
        try:
            await _in_time(_write(request, response, transport, body, network), network)
        except asyncio.TimeoutError:
            transport.abort()
        except ConnectionError:  # they have gone, or gave way: no fault of this server's
            pass
        finally:
            self._going.remove(going)
        return response


async def _in_time(writing: Coroutine[Any, Any, None], network: _Network) -> None:
    """Wait until a body is written.

    Raises
    ------
    asyncio.TimeoutError
        If its network takes too little meanwhile.
    """
    now = asyncio.get_running_loop().time
    begun_s, before_bytes = now(), network.taken_bytes
    task = asyncio.ensure_future(writing)
    try:
        while not task.done():
            patience_s = PATIENCE_S + (network.taken_bytes - before_bytes) / SLOWEST_BYTES_PER_S
            left_s = begun_s + patience_s - now()
            if left_s <= 0:
                raise asyncio.TimeoutError
            await asyncio.wait({task}, timeout=left_s)
        task.result()
    finally:
        task.cancel()


async def _write(
    request: web.Request,
    response: web.StreamResponse,
    transport: asyncio.WriteTransport,
    body: bytes,
    network: _Network,
) -> None:
    await response.prepare(request)
    whole = memoryview(body)
    for at in range(0, len(whole), PIECE_BYTES):
        piece = whole[at : at + PIECE_BYTES]
        await response.write(piece)
        network.taken_bytes += len(piece)
    while transport.get_write_buffer_size():  # else who leaves the last piece would be waited for without end
        await asyncio.sleep(_LOOK_S)
