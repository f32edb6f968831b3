"""Sets what the system does for connections: how much of what was written it holds back."""

import asyncio
import socket
from contextlib import suppress

from room.server.limits import MOST_UNSENT_BYTES


def hold_little(transport: asyncio.Transport) -> None:
    """Have the system take no more than goes out soon, where it can be told so: Linux and macOS."""
    wire = transport.get_extra_info("socket")
    if wire is None or wire.family not in (socket.AF_INET, socket.AF_INET6):
        return
    option = getattr(socket, "TCP_NOTSENT_LOWAT", None)
    if option is not None:
        with suppress(OSError):  # gone already
            wire.setsockopt(socket.IPPROTO_TCP, option, MOST_UNSENT_BYTES)
