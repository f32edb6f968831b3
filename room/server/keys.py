"""Makes and checks the keys of rooms: two for each name, which follow from one secret of the server.

Nothing is kept by room: whoever has the secret can make the links of any room, and links live as long as the secret.
"""

import base64
import hashlib
import hmac
import os
import secrets
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from facegen.files import output_errors
from room.errors import FormatError, InputError

_SECRET_BYTES = 32
_KEY_BYTES = 16
"""128 bits: 22 characters in a link."""

Role = Literal["guest", "moderator"]


@dataclass(frozen=True, kw_only=True)
class Keys:
    """The keys of all rooms of one server.

    Parameters
    ----------
    secret
        32 random bytes.
    """

    secret: bytes

    def key(self, room: str, role: Role) -> str:
        """What stands behind the ``#`` of a link, and makes of who has it a guest or a moderator of that room."""
        mark = hmac.digest(self.secret, f"room 1 {role} {room}".encode(), hashlib.sha256)
        return base64.urlsafe_b64encode(mark[:_KEY_BYTES]).decode().rstrip("=")

    def role(self, room: str, key: str) -> Role | None:
        """What a key makes of who has it; None where it is not of this room. Takes as long for each wrong one."""
        roles: tuple[Role, ...] = ("guest", "moderator")
        fits = [hmac.compare_digest(self.key(room, role), key) for role in roles]
        return next((role for role, fit in zip(roles, fits, strict=True) if fit), None)


def new_keys() -> Keys:
    """Keys that nobody had before, and that end with the process."""
    return Keys(secret=secrets.token_bytes(_SECRET_BYTES))


def load_keys(path: Path) -> Keys:
    """Read the secret of a file, which is made where there is none.

    Raises
    ------
    InputError, OutputError
        As `read_keys` and `keep_keys`.
    """
    if not path.exists():
        keep_keys(new_keys(), path)
    return read_keys(path)


def keep_keys(keys: Keys, path: Path) -> None:
    """Write a secret into a new file, for its owner alone.

    Raises
    ------
    OutputError
        If it cannot be made.
    """
    with output_errors(path):
        handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with open(handle, "w", encoding="ascii") as file:
            file.write(keys.secret.hex() + "\n")


def read_keys(path: Path) -> Keys:
    """Read the secret of a file.

    Raises
    ------
    InputError
        If the file cannot be read, or holds no secret.
    """
    try:
        with open(path, encoding="ascii") as file:
            text = file.read(2 * _SECRET_BYTES + 2).strip()
        secret = bytes.fromhex(text)
    except OSError as error:
        raise InputError(
            f"{path}: cannot be read ({os.strerror(error.errno or 0)}); name another --keys"
        ) from None
    except ValueError:
        secret = b""
    if len(secret) != _SECRET_BYTES:
        raise FormatError(
            f"{path}: holds no {2 * _SECRET_BYTES} hexadecimal digits; name a new file, and it is made"
        )
    return Keys(secret=secret)
