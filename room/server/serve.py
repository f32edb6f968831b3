"""Runs a server of rooms until it is stopped."""

import asyncio
import logging
import platform
import signal
import ssl
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from aiohttp import web
from aiohttp.http_exceptions import HttpProcessingError

from room.errors import InputError
from room.server.application import Rooms
from room.server.listener import Listener, allow_files, bind

KEEPALIVE_S = 30.0
"""A connection that asks nothing more ends: a page asks for what it needs at once."""

SHUTDOWN_S = 2.0
"""Time to tell everybody that the server stops; then connections are cut."""


@dataclass(frozen=True, kw_only=True)
class Address:
    """Where a server listens.

    Parameters
    ----------
    host
        Name or number of the interface; ``127.0.0.1`` is this machine alone.
    port
        0 for any that is free.
    certificate, private_key
        PEM files for https; none for http.
    """

    host: str = "127.0.0.1"
    port: int = 8443
    certificate: Path | None = None
    private_key: Path | None = None

    @property
    def scheme(self) -> str:
        """``https`` or ``http``."""
        return "https" if self.certificate else "http"

    @property
    def name(self) -> str:
        """What stands for the host in an address: nobody can open 0.0.0.0, so of all interfaces this machine's name."""
        if self.host in ("0.0.0.0", "::"):
            return platform.node()
        return f"[{self.host}]" if ":" in self.host else self.host


def serve(rooms: Rooms, address: Address, *, started: Callable[[str], None]) -> None:
    """Answer until Ctrl-C or SIGTERM, then tell everybody and return: that is how a server ends as it should.

    Parameters
    ----------
    rooms
        To be served.
    address
        Where.
    started
        Called with the address, ``http://127.0.0.1:8443``, as soon as connections are taken.

    Raises
    ------
    InputError
        If the address cannot be listened at, or the certificate cannot be used.
    """
    with suppress(KeyboardInterrupt):  # where a loop takes no signals; everybody was told on the way out
        asyncio.run(_serve(rooms, address, _tls(address), started))


async def _serve(
    rooms: Rooms, address: Address, tls: ssl.SSLContext | None, started: Callable[[str], None]
) -> None:
    application = rooms.application()
    sockets = await bind(address.host, address.port)
    runner = web.AppRunner(
        application,
        access_log=None,
        logger=_log(),
        shutdown_timeout=SHUTDOWN_S,
        keepalive_timeout=KEEPALIVE_S,
    )
    listener = Listener(lambda: _protocol(runner), tls=tls, most=allow_files())
    application.middlewares.append(listener.hear)
    application.on_response_prepare.append(listener.prepare)
    port = sockets[0].getsockname()[1]
    try:
        await runner.setup()
        async with listener.listening(sockets, failed=rooms.stopped.set):
            started(f"{address.scheme}://{address.name}:{port}")
            await _stopped(rooms.stopped)
    finally:
        for each in sockets:
            each.close()
        await runner.cleanup()


def _log() -> logging.Logger:
    """Where faults of this program go: what scanners send that is no HTTP is none, and holds their addresses."""
    log = logging.getLogger("room.server")
    log.addFilter(
        lambda record: not (record.exc_info and isinstance(record.exc_info[1], HttpProcessingError))
    )
    return log


def _protocol(runner: web.AppRunner) -> asyncio.Protocol:
    assert runner.server is not None
    return runner.server()


async def _stopped(stopped: asyncio.Event) -> None:
    """Wait for Ctrl-C, SIGTERM or a fault; where a loop takes no signals, as on Windows, they end it by themselves."""
    with suppress(NotImplementedError):
        for number in (signal.SIGINT, signal.SIGTERM):
            asyncio.get_running_loop().add_signal_handler(number, stopped.set)
    await stopped.wait()


def _tls(address: Address) -> ssl.SSLContext | None:
    if address.certificate is None and address.private_key is None:
        return None
    if address.certificate is None or address.private_key is None:
        raise InputError("https needs both --cert and --key, two PEM files")
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    try:
        context.load_cert_chain(address.certificate, address.private_key)
    except OSError as error:  # ssl.SSLError is one
        reason = getattr(error, "reason", None) or error.strerror or "cannot be read"
        raise InputError(
            f"{address.certificate}, {address.private_key}: no certificate with its key ({reason})"
        ) from None
    return context
