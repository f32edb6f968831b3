"""Says what a browser may do with the pages of a room, and from whose pages it may connect."""

from urllib.parse import urlsplit

from aiohttp import web

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


async def protect(request: web.Request, response: web.StreamResponse) -> None:
    """Put the headers on every answer; for ``Application.on_response_prepare``."""
    response.headers.update(HEADERS)


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
