"""Lets in who may look: addresses alone, the page's own origin, and a token where others can connect."""

import ipaddress
import secrets
from dataclasses import dataclass
from urllib.parse import urlsplit

from aiohttp import web

from facegen.errors import InputError

LEAST_TOKEN_CHARACTERS = 16
"""Of a token that somebody chose: 16 random letters and digits are beyond guessing."""

_OPEN = frozenset({"/page.js", "/page.css", "/LICENSES.txt"})
"""What every copy of track holds; a token guards the rest."""

HEADERS = {
    "Content-Security-Policy": "; ".join(
        (
            "default-src 'none'",
            "script-src 'self'",
            "style-src 'self'",
            # an avatar's own pictures become blob: addresses
            "img-src 'self' blob: data:",
            "connect-src 'self' blob: data:",
            "base-uri 'none'",
            "form-action 'none'",
            "frame-ancestors 'none'",
            "require-trusted-types-for 'script'",
        )
    ),
    "Permissions-Policy": "camera=(), microphone=(), geolocation=()",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-cache",
}


def is_loopback(host: str) -> bool:
    """Whether only this machine can connect to a host's name or address."""
    address = _address(host)
    return host.lower() == "localhost" if address is None else address.is_loopback


@dataclass(frozen=True, kw_only=True)
class Guard:
    """Judges requests.

    Parameters
    ----------
    host
        That is listened on.
    token
        That the link holds; none is asked for where it is empty.
    """

    host: str
    token: str

    @classmethod
    def of(cls, host: str, token: str | None) -> "Guard":
        """A guard for a host; a token is made where other machines can connect and none was given.

        Raises
        ------
        InputError
            The token is so short that it could be guessed.
        """
        if token and len(token) < LEAST_TOKEN_CHARACTERS:
            raise InputError(
                f"the page's token has {len(token)} characters; {LEAST_TOKEN_CHARACTERS} or more cannot be "
                f"guessed, and without one a token is made"
            )
        return cls(host=host, token=token or ("" if is_loopback(host) else secrets.token_urlsafe(32)))

    @property
    def is_shared(self) -> bool:
        """Whether other machines can connect."""
        return not is_loopback(self.host)

    def objection(self, request: web.Request) -> str | None:
        """Why a request is not answered, as a sentence; None where it is.

        A page of a stranger can make its own name mean 127.0.0.1 and ask as if it were ours. Its name then stands in
        the Host header, so only addresses, and names that nobody else gives, pass. Its WebSockets name it as Origin.
        """
        if not self._own(request.host):
            return "this page answers to its own address only, not to the name that was used"
        origin = request.headers.get("Origin")
        if origin is not None and _place(origin) != request.host.lower():
            return "this page answers to itself only, not to pages of others"
        if request.path in _OPEN or not self.token:
            return None
        given = request.query.get("token", "")
        if not secrets.compare_digest(given.encode(), self.token.encode()):
            return "the link's token is missing or wrong; use the whole link that track printed"
        return None

    def _own(self, host_header: str) -> bool:
        try:
            name = urlsplit(f"//{host_header}").hostname or ""
        except ValueError:
            return False
        if is_loopback(name) or name == self.host.lower():
            return True
        return self.is_shared and _address(name) is not None


def _place(origin: str) -> str:
    """Host and port of an origin; nothing of what is none."""
    try:
        return urlsplit(origin).netloc.lower()
    except ValueError:  # half an IPv6 address
        return ""


def _address(host: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    try:
        return ipaddress.ip_address(host)
    except ValueError:
        return None
