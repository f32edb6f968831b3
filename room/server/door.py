"""Keeps the door free for those who come: of connections that have not said who they are, the oldest give way."""

import ipaddress
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

from room.server.limits import MOST_STRANGERS

_NETWORK_BITS = 64
"""Of IPv6: a household has all addresses of such a network, and could come from each once."""


@dataclass(eq=False)
class Stranger:
    """A connection before its first text.

    Parameters
    ----------
    origin
        Network that it comes from.
    cut
        Ends it.
    """

    origin: str
    cut: Callable[[], None]


class Door:
    """All strangers of a server, in the order in which they came.

    Whoever opens connections and says nothing takes places from themselves alone, unless they have more networks than
    others have people: one who comes by a page is a stranger for the time of one answer.
    """

    def __init__(self, *, most: int = MOST_STRANGERS) -> None:
        self._most = most
        self._strangers: dict[Stranger, None] = {}

    def knock(self, address: str | None, cut: Callable[[], None]) -> Stranger:
        """Note one more; where too many stand, the oldest of the network that most come from is cut."""
        if len(self._strangers) >= self._most:
            crowd = Counter(stranger.origin for stranger in self._strangers).most_common(1)[0][0]
            oldest = next(stranger for stranger in self._strangers if stranger.origin == crowd)
            self.pass_by(oldest)
            oldest.cut()
        stranger = Stranger(origin=_network(address), cut=cut)
        self._strangers[stranger] = None
        return stranger

    def pass_by(self, stranger: Stranger) -> None:
        """They have said who they are, or gone."""
        self._strangers.pop(stranger, None)


def _network(address: str | None) -> str:
    try:
        parsed = ipaddress.ip_address((address or "").partition("%")[0])
    except ValueError:  # a socket of the system, behind a proxy on this machine
        return ""
    if isinstance(parsed, ipaddress.IPv6Address):
        if parsed.ipv4_mapped:
            return str(parsed.ipv4_mapped)
        return str(ipaddress.ip_network((parsed, _NETWORK_BITS), strict=False))
    return str(parsed)
