"""Somebody who asks for a WebSocket and cuts the connection before the answer."""

import base64
import socket
import struct
from urllib.parse import urlsplit


def hang_up(url: str) -> None:
    """Ask by HTTP, and leave by a reset, as a page does that is closed while it connects."""
    asked = urlsplit(url)
    words = (
        f"GET {asked.path} HTTP/1.1\r\nHost: {asked.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {base64.b64encode(bytes(16)).decode()}\r\n\r\n"
    )
    with socket.create_connection((asked.hostname, asked.port)) as caller:
        caller.sendall(words.encode())
        caller.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
