"""Says what a browser may do with the pages of a room, and from whose pages it may connect."""

import re
from urllib.parse import urlsplit

from aiohttp import web

from room.errors import InputError

HEADERS = {
    "Content-Security-Policy": "; ".join(
        (
            "default-src 'none'",
            "script-src 'self' 'wasm-unsafe-eval'",  # the face detector is WebAssembly; no eval of texts
            "worker-src 'self'",
            "connect-src 'self' blob:",  # its own WebSocket and files, and textures of avatars that were unpacked
            "img-src 'self' blob: data:",
            "media-src 'self' blob: mediastream:",
            "style-src 'self'",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'none'",
        )
    ),
    "Permissions-Policy": "camera=(self), microphone=(self), xr-spatial-tracking=(self), geolocation=()",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}

_PORTS = {"http": 80, "https": 443}
"""Which browsers do not name."""
_NETLOC = re.compile(r"[^\s@]*[^\s@:]")
"""Host and port, without a user."""


async def protect(request: web.Request, response: web.StreamResponse) -> None:
    """Put the headers on every answer; for ``Application.on_response_prepare``."""
    response.headers.update(HEADERS)


def parse_origin(text: str) -> str:
    """An address that people type, as browsers name it: ``https://rooms.example``.

    Raises
    ------
    InputError
        If it is none, or names more than scheme, host and port.
    """
    lower = text.lower()
    try:
        parts = urlsplit(lower)
        host = parts.hostname if parts.port != 0 else None
    except ValueError:  # half an IPv6 address, or a port beyond 65535
        host = None
    if host and parts.scheme in _PORTS and _NETLOC.fullmatch(parts.netloc):
        origin = f"{parts.scheme}://{parts.netloc}"
        if lower in (origin, f"{origin}/"):
            return origin.removesuffix(f":{_PORTS[parts.scheme]}")
    raise InputError(
        f"--origin {text!r}: is no address of a server; https://HOST is one, and https://HOST:PORT"
    )


def same_origin(request: web.Request, allowed: frozenset[str]) -> bool:
    """Whether a WebSocket is opened by a page of this server, or by a program, which says nothing of an origin.

    Parameters
    ----------
    request
        Of the WebSocket.
    allowed
        Origins of proxies, ``https://rooms.example``, whose pages are this server's as well.
    """
    origin = request.headers.get("Origin")
    if origin is None or origin in allowed:
        return True
    try:
        return urlsplit(origin).netloc == request.host
    except ValueError:  # half an IPv6 address
        return False
