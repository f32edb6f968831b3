"""Own avatars of people at other servers: they come in pieces, where there is a place for them."""

import asyncio
from collections.abc import Callable
from types import SimpleNamespace

import pytest

from room.avatars import AvatarStore, digest_of
from room.avatars.check import (
    MOST_AVATAR_BYTES,
)
from room.avatars.pieces import PIECE_BYTES, pack_piece, read_piece
from room.errors import FormatError
from room.protocol.accounts import Wanted
from room.server import new_keys
from room.server.avatar_requests import AvatarRequests
from room.server.avatar_transfer import AvatarTransfer
from room.server.room_avatars import RoomAvatars
from room.state import Meeting
from tests.room.avatars import avatar, textured


def test_an_avatar_comes_in_pieces_and_what_is_none_is_refused():
    digest, whole = "ab" * 32, bytes(range(256)) * 1024 + b"end"
    pieces = [read_piece(pack_piece(digest, whole, at)) for at in range(0, len(whole), PIECE_BYTES)]
    assert b"".join(piece.content for piece in pieces) == whole
    assert {(piece.digest, piece.total) for piece in pieces} == {(digest, len(whole))}
    good = pack_piece(digest, b"four", 0)
    for bad in (
        good[:-4],
        good + b"more",
        b"\x02" + good[1:],
        pack_piece(digest, bytes(MOST_AVATAR_BYTES + 1), 0),
        good[:33] + (5).to_bytes(4, "little") + (2).to_bytes(4, "little") + good[41:],
    ):
        with pytest.raises(FormatError):
            read_piece(bad)


class _Channels:
    """Another server beside this one, which sends what it is asked for."""

    def __init__(self, avatar: bytes) -> None:
        self.process, self.avatar, self.sent = "0" * 16, avatar, 0

    def listen(self, hear: Callable[[bytes], None]) -> None:
        self.hear = hear

    def say(self, _: str, said: bytes) -> None:
        self.sent += 1
        wanted = Wanted.model_validate_json(said)
        asyncio.get_running_loop().call_soon(self.hear, pack_piece(wanted.digest, self.avatar, wanted.at))


def _away(content: bytes, *, most_bytes: int) -> tuple[_Channels, AvatarRequests, str]:
    """A server with somebody of another one who wears an avatar, and its digest."""
    channels, store, keys = _Channels(content), AvatarStore(most_bytes=most_bytes), new_keys()
    meeting = Meeting(most_people=8, process="here")
    seat = meeting.settle(None, 7, "a" * 16)
    seat.home, seat.own = "there", digest_of(content)
    avatars = RoomAvatars("lab", meeting, store, AvatarTransfer(channels, store))
    room = SimpleNamespace(name="lab", avatars=avatars)
    return channels, AvatarRequests(keys, store, lambda _: room, frozenset()), seat.own


def test_of_an_avatar_of_another_server_that_does_not_fit_one_piece_comes():
    content = bytes(4 * PIECE_BYTES)

    async def run() -> None:
        channels, requests, digest = _away(content, most_bytes=len(content))
        room = requests._room_of("lab")
        assert await requests._transferred(digest, room) is None
        assert channels.sent == 1
        assert (
            await _away(content, most_bytes=2 * len(content))[1]._room_of("lab").avatars.transferred(digest)
        )

    asyncio.run(asyncio.wait_for(run(), 300))


def test_what_was_refused_of_another_server_does_not_come_again_soon(monkeypatch):
    async def run() -> None:
        channels, requests, digest = _away(textured(b"<svg>"), most_bytes=2**20)
        for _ in range(3):
            assert await requests._transferred(digest, requests._room_of("lab")) is None
        assert channels.sent == 1
        monkeypatch.setattr("room.server.avatar_requests.REFUSED_S", 0)
        requests._refused.clear()
        for _ in range(2):
            assert await requests._transferred(digest, requests._room_of("lab")) is None
        assert channels.sent == 3
        await requests.close()

    asyncio.run(asyncio.wait_for(run(), 300))


def test_what_is_whole_of_another_server_is_kept():
    async def run() -> None:
        _, requests, digest = _away(avatar(), most_bytes=2**20)
        for _ in range(2):
            assert await requests._transferred(digest, requests._room_of("lab")) == avatar()
        await requests.close()

    asyncio.run(asyncio.wait_for(run(), 300))
