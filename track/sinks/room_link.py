"""Reads what stands behind ``room:``, a person's own link, and the file of the room's certificate.

The room's page shows the link to its person: ``http://HOST:PORT/room/NAME#KEY.SECRET``.
"""

import base64
import hashlib
import os
import re
from dataclasses import dataclass
from urllib.parse import urlsplit

from track.errors import InputError
from track.sinks.targets import Target

_PATH = re.compile(r"/room/([a-z0-9][a-z0-9-]{0,39})")
_KEYS = re.compile(r"([A-Za-z0-9_-]{22})\.([A-Za-z0-9_-]{22,64})")
_CERTIFICATE = re.compile(rb"-----BEGIN CERTIFICATE-----(.+?)-----END CERTIFICATE-----", re.DOTALL)
_MOST_CERTIFICATE_BYTES = 2**16


@dataclass(frozen=True, kw_only=True)
class RoomLink:
    """A person's way into a room.

    Parameters
    ----------
    title
        What a person calls it, without its secret.
    address
        Of the room's socket.
    key, secret
        Of the room and the person.
    certificate
        File of the room's certificate, where one is named.
    sha256
        Of the certificate itself.
    """

    title: str
    address: str
    key: str
    secret: str
    certificate: str | None = None
    sha256: bytes | None = None


def read_link(target: Target) -> RoomLink:
    """Understand a link; what is said of a wrong one does not repeat its secret.

    Raises
    ------
    InputError
        Where it is none of a person in a room, or its certificate's file holds none.
    """
    try:
        link = urlsplit(target.place)
        served = link.scheme in ("http", "https") and bool(link.hostname) and link.port != 0
    except ValueError:  # half of an IPv6 address, a port beyond 65535
        served = False
    keys = _KEYS.fullmatch(link.fragment) if served and _PATH.fullmatch(link.path) else None
    if keys is None:
        raise InputError(
            "--to room: the link is none of a person's face; the room's page shows it as "
            "http://HOST:PORT/room/NAME#KEY.SECRET"
        )
    file = target.options.get("cert")
    if file is not None and link.scheme != "https":
        raise InputError("--to room: cert= is for a link that begins with https://; leave it out")
    return RoomLink(
        title=target.title,
        address=f"{link.scheme}://{link.netloc}{link.path}/socket",
        key=keys[1],
        secret=keys[2],
        certificate=file,
        sha256=None if file is None else _sha256_of(file),
    )


def _sha256_of(path: str) -> bytes:
    """Of a file's first certificate, which is the server's own one, whoever signed it."""
    try:
        with open(path, "rb") as file:
            found = _CERTIFICATE.search(file.read(_MOST_CERTIFICATE_BYTES))
        certificate = b"" if found is None else base64.b64decode(found[1])
    except OSError as error:
        raise InputError(
            f"--to room: cert={path} cannot be read ({os.strerror(error.errno)}); name a copy of the file of "
            "`room serve --cert`"
        ) from error
    except ValueError:  # half of a certificate
        certificate = b""
    if not certificate:
        raise InputError(
            f"--to room: cert={path} holds no certificate, which begins with -----BEGIN CERTIFICATE-----; name a copy "
            "of the file of `room serve --cert`"
        )
    return hashlib.sha256(certificate).digest()
