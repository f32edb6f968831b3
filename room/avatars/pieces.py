"""Packs one piece of an avatar that goes from the process that took it to one that asked.

Little endian: u8 3, SHA-256 of the whole, u32 length of the whole, u32 where the piece begins, and its bytes.
"""

import struct
from dataclasses import dataclass

from room.avatars.check import MOST_AVATAR_BYTES
from room.errors import FormatError

PIECE_BYTES = 256 * 1024
"""Of one piece: an avatar of 2 MB takes eight, and Redis holds one of them at a time for who asked."""

_KIND = 3
_HEAD = struct.Struct("<B32sII")


@dataclass(frozen=True, kw_only=True)
class Piece:
    """Some bytes of an avatar.

    Parameters
    ----------
    digest
        SHA-256 of the whole, as 64 digits.
    total
        Length of the whole, in bytes.
    at
        Where these begin.
    content
        At most `PIECE_BYTES`; never none.
    """

    digest: str
    total: int
    at: int
    content: bytes


def pack_piece(digest: str, avatar: bytes, at: int) -> bytes:
    """The piece of an avatar that begins at a place within it."""
    return _HEAD.pack(_KIND, bytes.fromhex(digest), len(avatar), at) + avatar[at : at + PIECE_BYTES]


def read_piece(content: bytes) -> Piece:
    """Read a piece.

    Raises
    ------
    FormatError
        If it is none, or of an avatar that is too large, or reaches beyond it.
    """
    size = len(content) - _HEAD.size
    if not 0 < size <= PIECE_BYTES:
        raise FormatError(f"a piece of an avatar has 1 to {PIECE_BYTES:,} bytes, and this one has {size:,}")
    kind, digest, total, at = _HEAD.unpack_from(content)
    if kind != _KIND or total > MOST_AVATAR_BYTES or at + size > total:
        raise FormatError(f"no piece of an avatar: kind {kind}, {size:,} bytes from {at:,} of {total:,}")
    return Piece(digest=digest.hex(), total=total, at=at, content=content[_HEAD.size :])
