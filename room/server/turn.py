"""Gives browsers the addresses that WebRTC needs, with credentials of a relay that end with the day.

Credentials are those of coturn's ``use-auth-secret`` (draft-uberti-behave-turn-rest-00): the user is a time and a
name, the password is that text's HMAC-SHA1 under a secret that the relay and this server share.
"""

import base64
import hashlib
import hmac
from dataclasses import dataclass

from room.protocol.answers import IceServer

LASTS_S = 12 * 3600
"""A credential ends after the longest meeting; a page that comes back gets a new one."""


@dataclass(frozen=True, kw_only=True)
class Relays:
    """Where browsers find each other.

    Parameters
    ----------
    stun, turn
        Addresses, ``stun:HOST:PORT`` and ``turn:HOST:PORT``.
    secret
        Shared with the relay; needed where there is one.
    """

    stun: tuple[str, ...] = ()
    turn: tuple[str, ...] = ()
    secret: str = ""

    def servers(self, person: str, *, now_s: float) -> tuple[IceServer, ...]:
        """What a person's browser is told.

        Parameters
        ----------
        person
            Their id, by which the relay counts.
        now_s
            Seconds since 1970.
        """
        servers = (IceServer(urls=self.stun),) if self.stun else ()
        if not self.turn:
            return servers
        user = f"{int(now_s) + LASTS_S}:{person}"
        mark = hmac.digest(self.secret.encode(), user.encode(), hashlib.sha1)
        return (
            *servers,
            IceServer(urls=self.turn, username=user, credential=base64.b64encode(mark).decode()),
        )
