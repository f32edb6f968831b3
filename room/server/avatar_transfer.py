"""Fetches own avatars from the server that took them: on asking, once, in pieces, from memory to memory."""

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING

from room.avatars import AvatarStore
from room.avatars.pieces import Piece, pack_piece, read_piece
from room.avatars.store import digest_of
from room.errors import FormatError
from room.protocol.accounts import Wanted

if TYPE_CHECKING:  # needs an extra of its own
    from room.server.redis_channels import RedisChannels

MOST_TRANSFERS = 4
"""Avatars that come from other servers at one time: each is held whole until it is checked."""

PIECE_S = 2.0
TRIES = 3
"""Time for one piece, and how often it is asked for; then nobody has the avatar."""


class AvatarTransfer:
    """Asks the other processes for avatars, and takes in what they send.

    Parameters
    ----------
    channels
        Reach them.
    store
        What this process has taken itself.
    """

    def __init__(self, channels: "RedisChannels", store: AvatarStore) -> None:
        self._channels, self._store = channels, store
        self._transferring: dict[str, asyncio.Task[bytes | None]] = {}
        self._awaited: dict[tuple[str, int], asyncio.Future[Piece]] = {}
        self._few = asyncio.Semaphore(MOST_TRANSFERS)
        channels.listen(self._hear)

    async def fetch(self, room: str, digest: str, fits: Callable[[int], bool]) -> bytes | None:
        """An avatar that somebody wears in a room by another process; None where none of them sends it.

        Whoever asks while it is on its way waits for the same. Of one whose length does not fit, nothing comes but the
        first piece, which says it.
        """
        if digest not in self._transferring:
            task = self._transferring[digest] = asyncio.create_task(self._transfer(room, digest, fits))
            task.add_done_callback(lambda _: self._transferring.pop(digest))
        return await asyncio.shield(self._transferring[digest])

    def send(self, room: str, wanted: Wanted) -> None:
        """Send the piece that another process wants, to it alone."""
        avatar = self._store.get(wanted.digest, room)
        if avatar is not None and wanted.at < len(avatar):
            self._channels.say(f"/{wanted.process}", pack_piece(wanted.digest, avatar, wanted.at))

    async def _transfer(self, room: str, digest: str, fits: Callable[[int], bool]) -> bytes | None:
        avatar, total = bytearray(), 1
        async with self._few:
            while len(avatar) < total:
                piece = await self._piece(room, digest, len(avatar))
                if piece is None or (avatar and piece.total != total):
                    return None
                if not avatar and not fits(piece.total):
                    return None
                avatar, total = avatar + piece.content, piece.total
        return bytes(avatar) if digest_of(avatar) == digest else None

    async def _piece(self, room: str, digest: str, at: int) -> Piece | None:
        wanted = Wanted(process=self._channels.process, digest=digest, at=at)
        for _ in range(TRIES):
            came = self._awaited[digest, at] = asyncio.get_running_loop().create_future()
            self._channels.say(room, wanted.model_dump_json().encode())
            try:
                return await asyncio.wait_for(came, PIECE_S)
            except asyncio.TimeoutError:
                continue
            finally:
                del self._awaited[digest, at]
        return None

    def _hear(self, content: bytes) -> None:
        try:
            piece = read_piece(content)
        except FormatError:
            return
        came = self._awaited.get((piece.digest, piece.at))
        if came and not came.done():
            came.set_result(piece)
