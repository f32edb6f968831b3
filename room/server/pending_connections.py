"""Limits connections that have not said yet who they are: where there are too many, the oldest is ended."""

import ipaddress
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

from room.server.limits import MOST_PENDING

_NETWORK_BITS = 64
"""Of IPv6: a household has all addresses of such a network, and could come from each once."""


@dataclass(eq=False)
class PendingConnection:
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


class PendingConnections:
    """The connections of a server that have not joined yet, in the order in which they came.

    Whoever opens connections and says nothing takes places from themselves alone, unless they have more networks than
    others have people: who comes by a page is pending for the time of one answer.
    """

    def __init__(self, *, most: int = MOST_PENDING) -> None:
        self._most = most
        self._connections: dict[PendingConnection, None] = {}

    def add(self, address: str | None, cut: Callable[[], None]) -> PendingConnection:
        """Note one more; where there are too many, the oldest of the network that most come from is cut."""
        if len(self._connections) >= self._most and (oldest := self.crowd()):
            self.remove(oldest)
            oldest.cut()
        pending = PendingConnection(origin=_network(address), cut=cut)
        self._connections[pending] = None
        return pending

    def crowd(self) -> PendingConnection | None:
        """The oldest of the network that most come from; None where none is pending."""
        if not self._connections:
            return None
        crowd = Counter(each.origin for each in self._connections).most_common(1)[0][0]
        return next(each for each in self._connections if each.origin == crowd)

    def remove(self, pending: PendingConnection) -> None:
        """Forget one that has said who it is, or has ended."""
        self._connections.pop(pending, None)


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
