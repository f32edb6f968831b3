"""Accepts connections: cuts those that ask nothing, and never has more than the system gives files for.

Where there are too many, those of people in rooms stay: a file can be asked for again, and a person would be away.
asyncio's own servers have no such bound, and write thousands of lines a second where a process has no file left.
"""

import asyncio
import errno
import os
import socket
import ssl
import weakref
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass

from aiohttp import web

from room.errors import InputError
from room.server.limits import MOST_CONNECTIONS
from room.server.pending_connections import PendingConnection, PendingConnections
from room.server.supervised import supervised

REQUEST_S = 10.0
"""Time for TLS, and again for the first request; what has not come whole by then ends."""

_SPARE_FILES = 96
"""For what a process opens beside connections: libraries, recordings, Redis, Janus, and what it sends from disk."""

_WAIT_S = 0.5
"""After the system gave no connection for want of files or memory."""

_OVERLOADED = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)


def allow_files() -> int:
    """Raise the bound on this process's open files as far as it may be; gives how many connections that allows."""
    try:
        import resource
    except ImportError:  # Windows has no such bound
        return MOST_CONNECTIONS
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = MOST_CONNECTIONS + _SPARE_FILES
    most = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
    if soft != resource.RLIM_INFINITY and soft < most:
        with suppress(OSError, ValueError):  # a system may allow less than it says
            resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))
            soft = most
    files = wanted if soft == resource.RLIM_INFINITY else soft
    return max(16, min(MOST_CONNECTIONS, files - _SPARE_FILES))


@dataclass(eq=False)
class _Taken:
    """A connection from when it was accepted; ``asked`` once a whole request came by it.

    ``pending`` is its place among those that give way; none once it is a WebSocket.
    """

    wire: socket.socket
    number: int
    pending: PendingConnection | None = None
    taking: "asyncio.Task[None] | None" = None
    transport: asyncio.BaseTransport | None = None
    asked: bool = False

    def cut(self) -> None:
        """End it, whatever waits on it."""
        if self.taking is not None:
            self.taking.cancel()
        if isinstance(self.transport, asyncio.WriteTransport):
            self.transport.abort()


class Listener:
    """The connections of one server.

    Parameters
    ----------
    protocol
        Makes what answers a connection.
    tls
        None for http.
    most
        Connections at one time. With more the oldest that asked nothing yet gives way, of the network that most of
        these come from; where all have asked, the oldest that is no WebSocket does; where all are, the new one.
    """

    def __init__(
        self, protocol: Callable[[], asyncio.Protocol], *, tls: ssl.SSLContext | None, most: int
    ) -> None:
        self._protocol, self._tls, self._most = protocol, tls, most
        self._taken: dict[int, _Taken] = {}
        self._silent, self._asked = PendingConnections(most=most), PendingConnections(most=most)

    @web.middleware
    async def hear(
        self, request: web.Request, handler: Callable[[web.Request], Awaitable[web.StreamResponse]]
    ) -> web.StreamResponse:
        """Note that a connection has asked something: a middleware of the application."""
        if (taken := self._taken_by(request)) and not taken.asked:
            self._forget(taken)
            taken.asked = True
            transport = weakref.ref(request.transport)  # which ends without a word to this
            taken.pending = self._asked.add(request.remote, lambda: self._cut(taken, transport()))
        return await handler(request)

    async def prepare(self, request: web.Request, response: web.StreamResponse) -> None:
        """Note that a connection is a WebSocket, for ``Application.on_response_prepare``: it gives way no more.

        What says nothing on one ends by itself (`room.server.room_sockets`).
        """
        if isinstance(response, web.WebSocketResponse) and (taken := self._taken_by(request)):
            self._forget(taken)

    def _taken_by(self, request: web.Request) -> _Taken | None:
        wire = request.transport and request.transport.get_extra_info("socket")
        return None if wire is None else self._taken.get(wire.fileno())

    @asynccontextmanager
    async def listening(
        self, sockets: Sequence[socket.socket], *, failed: Callable[[], None]
    ) -> AsyncIterator[None]:
        """Accept until the context ends; ``failed`` is called if that ends by a fault of this program."""
        jobs = [lambda bound=bound: self._accept(bound) for bound in sockets]
        try:
            async with supervised(*jobs, failed=failed):
                yield
        finally:
            for bound in sockets:
                bound.close()
            for taken in list(self._taken.values()):
                if not taken.asked:
                    taken.cut()

    async def _accept(self, bound: socket.socket) -> None:
        loop = asyncio.get_running_loop()
        while True:
            try:
                wire, address = await loop.sock_accept(bound)
            except OSError as error:
                # who connects and leaves at once is no reason to wait
                if error.errno in _OVERLOADED:
                    await asyncio.sleep(_WAIT_S)
                continue
            self._take(wire, address[0] if address else None)
            await asyncio.sleep(0)  # what waits to be accepted is given without a pause

    def _take(self, wire: socket.socket, address: str | None) -> None:
        if len(self._taken) >= self._most:
            self._sweep()
        for waiting in (self._silent, self._asked):
            if len(self._taken) >= self._most and (oldest := waiting.crowd()):
                waiting.remove(oldest)
                oldest.cut()
        if len(self._taken) >= self._most:
            wire.close()
            return
        if before := self._taken.get(wire.fileno()):  # it has ended: the system gave its number again
            self._forget(before)
        taken = self._taken[wire.fileno()] = _Taken(wire, wire.fileno())
        taken.pending = self._silent.add(address, lambda: self._cut(taken))
        taken.taking = asyncio.create_task(self._open(taken))

    def _cut(self, taken: _Taken, transport: asyncio.Transport | None = None) -> None:
        if self._taken.get(taken.number) is taken:
            del self._taken[taken.number]
        taken.transport = transport or taken.transport
        taken.cut()

    async def _open(self, taken: _Taken) -> None:
        """From being accepted to the first request."""
        loop = asyncio.get_running_loop()
        try:
            handshake = REQUEST_S if self._tls else None
            taken.transport, _ = await loop.connect_accepted_socket(
                self._protocol, taken.wire, ssl=self._tls, ssl_handshake_timeout=handshake
            )
            await asyncio.sleep(REQUEST_S)
            if not taken.asked:
                self._cut(taken)
        except (OSError, asyncio.TimeoutError):  # no TLS, or gone; ssl.SSLError is one
            taken.wire.close()
        finally:
            if not taken.asked:
                self._forget(taken)
            taken.transport = taken.taking = None

    def _forget(self, taken: _Taken) -> None:
        if taken.pending is not None:
            self._silent.remove(taken.pending)
            self._asked.remove(taken.pending)
            taken.pending = None

    def _sweep(self) -> None:
        """Forget those that have ended: only where there seem to be too many, as each look costs."""
        for number, taken in list(self._taken.items()):
            if taken.wire.fileno() != number:
                self._forget(taken)
                del self._taken[number]


async def bind(host: str, port: int) -> list[socket.socket]:
    """Sockets that listen at all addresses of a host.

    Raises
    ------
    InputError
        If the address cannot be listened at.
    """
    bound: list[socket.socket] = []
    try:
        found = await asyncio.get_running_loop().getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )
        for family, _, _, _, address in dict.fromkeys(found):
            bound.append(_bound(family, address))
    except (OSError, UnicodeError) as error:  # UnicodeError: a name with an empty or too long part
        for each in bound:
            each.close()
        number = getattr(error, "errno", None) or 0
        reason = os.strerror(number) if number > 0 else getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"{host}:{port}: cannot be listened at ({reason}); name another --host or --port"
        ) from None
    return bound


def _bound(family: int, address: tuple) -> socket.socket:
    wire = socket.socket(family, socket.SOCK_STREAM)
    try:
        if os.name == "posix":
            wire.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if family == socket.AF_INET6:
            wire.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
        wire.bind(address)
        wire.listen(128)
        wire.setblocking(False)
    except OSError:
        wire.close()
        raise
    return wire
