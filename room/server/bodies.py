"""Sends what is large in pieces, as fast as it is taken: who asks for many files and reads nothing takes no memory."""

import asyncio
from collections.abc import Awaitable, Callable

from aiohttp import web

from room.server.limits import MOST_BODIES
from room.server.pending_connections import PendingConnections

PIECE_BYTES = 64 * 1024
"""Written at once; the next piece goes once the network has taken nearly all. What is smaller goes whole."""

SLOWEST_BYTES_PER_S = 16 * 1024
"""Who takes less of a body is cut: a meeting needs ten times as much."""

PATIENCE_S = 30.0
"""For any body beside that: a telephone's change of networks takes ten seconds."""

_LOOK_S = 0.05
"""Between looks whether the last piece has gone."""


class Bodies:
    """The large answers on their way from a server.

    With more than `room.server.limits.MOST_BODIES` the oldest of the network that most of them go to is cut.
    """

    def __init__(self) -> None:
        self._going = PendingConnections(most=MOST_BODIES)

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
        response = web.StreamResponse(status=answer.status, headers=answer.headers)
        response.content_length = len(body)
        try:
            await asyncio.wait_for(
                _write(request, response, transport, body), PATIENCE_S + len(body) / SLOWEST_BYTES_PER_S
            )
        except asyncio.TimeoutError:
            transport.abort()
        except ConnectionError:  # they have gone, or gave way: no fault of this server's
            pass
        finally:
            self._going.remove(going)
        return response


async def _write(
    request: web.Request, response: web.StreamResponse, transport: asyncio.WriteTransport, body: bytes
) -> None:
    await response.prepare(request)
    whole = memoryview(body)
    for at in range(0, len(whole), PIECE_BYTES):
        await response.write(whole[at : at + PIECE_BYTES])
    while transport.get_write_buffer_size():  # else who leaves the last piece would be waited for without end
        await asyncio.sleep(_LOOK_S)
