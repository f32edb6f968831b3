"""Takes people's own avatars in, and gives them to those who have the room's key.

``POST /room/NAME/avatar`` with ``Authorization: Bearer KEY.SECRET`` and the file as its body, from somebody who is in
the room; ``GET /room/NAME/avatar/SHA-256`` with ``Bearer KEY``. A refusal is a sentence as plain text.
"""

import asyncio
import re
from collections.abc import Callable

from aiohttp import web

from room.avatars import AvatarStore
from room.avatars.check import MOST_AVATAR_BYTES
from room.errors import FormatError, NotAllowed
from room.server.avatar_checks import AvatarChecks
from room.server.headers import same_origin
from room.server.keys import Keys
from room.server.limits import MOST_UPLOADS, MOST_UPLOADS_A_ROOM, UPLOADS_BURST, UPLOADS_PER_S, Bucket
from room.server.live_room import LiveRoom
from room.state import Seat, identity

UPLOAD_S = 120.0
"""For one file: the largest at 2.3 Mbit/s."""

REFUSED_S = 120.0
"""What came from another server and was refused is not asked for so long; pages ask again after two seconds."""

_BEARER = re.compile(r"Bearer ([A-Za-z0-9_-]{22})(?:\.([A-Za-z0-9_-]{22,64}))?")
DIGEST = re.compile(r"[0-9a-f]{64}")


class AvatarRequests:
    """The two handlers.

    Parameters
    ----------
    keys
        Of all rooms.
    store
        Where avatars are kept.
    room_of
        The room of a name, while somebody is in it.
    origins
        Of proxies in front of this server.
    """

    def __init__(
        self,
        keys: Keys,
        store: AvatarStore,
        room_of: Callable[[str], LiveRoom | None],
        origins: frozenset[str],
    ) -> None:
        self._keys, self._store, self._room_of, self._origins = keys, store, room_of, origins
        self._uploading: set[tuple[str, str]] = set()
        self._refused: dict[str, float] = {}
        self._checks, self._checking = AvatarChecks(), asyncio.Lock()

    async def take(self, request: web.Request) -> web.Response:
        """An upload."""
        if not same_origin(request, self._origins):
            raise web.HTTPForbidden(text="another site's page may not come in\n")
        room, seat = self._who(request)
        _refuse_undressed(room, seat)
        if not room.avatars.uploads.setdefault(seat.id, Bucket(UPLOADS_PER_S, burst=UPLOADS_BURST)).take(
            now=asyncio.get_running_loop().time()
        ):
            raise web.HTTPTooManyRequests(text="too many avatars at once; wait half a minute\n")
        wearer = (room.name, seat.id)
        if wearer in self._uploading:  # who sends four slowly would keep all others from theirs
            raise web.HTTPTooManyRequests(
                text="another avatar of yours is on its way; wait until it is there\n"
            )
        here = sum(name == room.name for name, _ in self._uploading)
        if here >= MOST_UPLOADS_A_ROOM or len(self._uploading) >= MOST_UPLOADS:
            raise web.HTTPServiceUnavailable(text="many bring avatars at once; try again in a minute\n")
        self._uploading.add(wearer)
        try:
            content = await asyncio.wait_for(_body(request), UPLOAD_S)
            await self._checks.check(content)
            if room.meeting.seat(seat.id) is not seat:
                raise web.HTTPForbidden(text="you have left the room\n")
            _refuse_undressed(room, seat)  # meanwhile
            return web.json_response({"own": room.put_on(seat, content)})
        except asyncio.TimeoutError:
            raise web.HTTPRequestTimeout(
                text=f"the avatar did not arrive in {UPLOAD_S:g} seconds\n"
            ) from None
        except ConnectionError:  # they have gone: no fault of this server's, and nobody reads the answer
            raise web.HTTPBadRequest(text="the avatar broke off\n") from None
        except FormatError as error:
            raise web.HTTPUnprocessableEntity(text=f"{error}\n") from None
        except NotAllowed as error:
            busy = web.HTTPServiceUnavailable if error.again else web.HTTPInsufficientStorage
            raise busy(
                text=f"{error}\n"
            ) from None  # pages bring it again to who is busy, and not where it is full
        finally:
            self._uploading.remove(wearer)

    async def give(self, request: web.Request) -> web.Response:
        """A download; the page asks once for each avatar."""
        name, digest = request.match_info["name"], request.match_info["digest"]
        self._secret_of(request)
        content = None
        if DIGEST.fullmatch(digest):
            content = self._store.get(digest, name) or await self._transferred(digest, self._room_of(name))
        if content is None:
            raise web.HTTPNotFound(text="nobody wears this avatar any more\n")
        headers = {"Cache-Control": "no-store"}  # it is somebody's; the page holds it while they are there
        return web.Response(body=content, content_type="model/gltf-binary", headers=headers)

    async def close(self) -> None:
        """Check no more."""
        await self._checks.close()

    async def _transferred(self, digest: str, room: LiveRoom | None) -> bytes | None:
        """From another server of the room, checked as if it had been brought here; None where that cannot be."""
        now = asyncio.get_running_loop().time()
        self._refused = {each: until for each, until in self._refused.items() if until > now}
        if digest in self._refused:
            return None
        content = await room.avatars.transferred(digest) if room else None
        if room is None or content is None:
            return None
        try:
            async with self._checking:
                if self._store.get(digest, room.name) is None:  # who waited for the same may have kept it
                    await self._checks.check(content)
                    room.avatars.keep(digest, content)
        except (FormatError, NotAllowed):
            self._refused[digest] = now + REFUSED_S
            return None
        return self._store.get(digest, room.name)

    def _who(self, request: web.Request) -> tuple[LiveRoom, Seat]:
        secret = self._secret_of(request)
        room = self._room_of(request.match_info["name"])
        seat = room.meeting.seat(identity(secret)) if room and secret else None
        if room is None or seat is None or seat.home != room.meeting.process:
            raise web.HTTPForbidden(text="only who is in the room brings an avatar; come in first\n")
        return room, seat

    def _secret_of(self, request: web.Request) -> str | None:
        found = _BEARER.fullmatch(request.headers.get("Authorization", ""))
        if found is None or self._keys.role(request.match_info["name"], found[1]) is None:
            raise web.HTTPForbidden(
                text="this link is not, or no longer, one of this room; ask for a new one\n"
            )
        return found[2]


def _refuse_undressed(room: LiveRoom, seat: Seat) -> None:
    if room.meeting.rulings.is_undressed(seat.id):
        raise web.HTTPForbidden(text="a moderator has taken your own avatar off; choose one of the room's\n")


async def _body(request: web.Request) -> bytes:
    """The whole body, never more than is allowed.

    Raises
    ------
    aiohttp.web.HTTPRequestEntityTooLarge
        If it says that it is larger, or is.
    """
    pieces, size = [], request.content_length or 0
    if size <= MOST_AVATAR_BYTES:
        size = 0
        async for piece in request.content.iter_any():
            size += len(piece)
            if size > MOST_AVATAR_BYTES:
                break
            pieces.append(piece)
    if size > MOST_AVATAR_BYTES:
        raise web.HTTPRequestEntityTooLarge(
            MOST_AVATAR_BYTES,
            size,
            text=f"this avatar is larger than {MOST_AVATAR_BYTES:,} bytes, the most that is shown to others; "
            "export it with smaller textures\n",
        )
    return b"".join(pieces)
