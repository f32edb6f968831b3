"""Answers requests: the page, its files, the WebSocket of each room, health and metrics."""

import asyncio
from collections.abc import AsyncIterator, Mapping, Sequence
from contextlib import AsyncExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from aiohttp import web

from room.avatars import AvatarStore
from room.places import PLAIN, Place
from room.protocol.answers import About
from room.protocol.texts import MOST_TEXT_BYTES
from room.recording import Recorder, Survey
from room.server.avatar_requests import AvatarRequests
from room.server.bodies import Bodies
from room.server.files import Files, answer, hold
from room.server.headers import protect
from room.server.janus import Janus
from room.server.keys import Keys
from room.server.limits import Limits
from room.server.live_rooms import LiveRooms
from room.server.metrics import Metrics
from room.server.room_sockets import ROOM_NAME, RoomSockets
from room.server.supervised import supervised
from room.server.turn import Relays

if TYPE_CHECKING:  # needs an extra of its own
    from room.server.redis_channels import RedisChannels

STATIC = Path(__file__).with_name("static")
"""What ``make web`` builds: the page, its script and the parts that it loads."""


class Rooms:
    """The rooms of one process, as the handlers of an application.

    Parameters
    ----------
    keys
        Of all rooms.
    limits
        What is allowed.
    relays
        What browsers are told for their voices.
    origins
        Of proxies in front of this server.
    recorder
        Records its one room; None where nothing is recorded.
    channels
        Reach the other processes that carry the same rooms; None where this is the only one.
    engines
        Janus instances that share the rooms' voices; none where these go from page to page.
    places
        Where people meet, by the name of the room; an empty name stands for all others.
    replayed
        Recording that every room of this server plays; None where people meet each other alone.

    Attributes
    ----------
    stopped
        Set when the server has to end: the ticks, or what reaches other processes and engines, have failed.
    """

    def __init__(
        self,
        keys: Keys,
        *,
        limits: Limits,
        relays: Relays,
        origins: frozenset[str] = frozenset(),
        recorder: Recorder | None = None,
        replayed: Survey | None = None,
        places: Mapping[str, Place] | None = None,
        channels: "RedisChannels | None" = None,
        engines: Sequence[Janus] = (),
    ) -> None:
        self._channels, self._engines, self._replayed = channels, engines, replayed
        self._files, self._avatar_store, self.metrics = Files(STATIC), AvatarStore(), Metrics()
        self._live_rooms = LiveRooms(
            keys.secret,
            limits=limits,
            relays=relays,
            store=self._avatar_store,
            recorder=recorder,
            replayed=replayed,
            channels=channels,
            engines=engines,
        )
        self._sockets = RoomSockets(keys, self._live_rooms, origins, self.metrics)
        self._avatar_requests = AvatarRequests(keys, self._avatar_store, self._live_rooms.get, origins)
        self._places = {room: hold(place.content, ".glb") for room, place in (places or {}).items()}
        self.stopped = asyncio.Event()

    def record(self, recorder: Recorder) -> None:
        """Record its one room from now on, before anybody is in: for who makes the file once the server listens."""
        self._live_rooms.record(recorder)

    def application(self) -> web.Application:
        """Everything that is answered, and the ticks behind it."""
        application = web.Application(client_max_size=MOST_TEXT_BYTES, middlewares=[Bodies().pace])
        application.router.add_get("/", self._outside)
        application.router.add_get("/avatars.json", self._avatars)
        application.router.add_get("/health", self._health)
        application.router.add_get("/metrics", self._count)
        application.router.add_get("/room/{name}", self._page)
        application.router.add_get("/room/{name}/about.json", self._about)
        application.router.add_get("/room/{name}/place.glb", self._place)
        application.router.add_get("/room/{name}/socket", self._sockets.answer)
        application.router.add_post("/room/{name}/avatar", self._avatar_requests.take)
        application.router.add_get("/room/{name}/avatar/{digest}", self._avatar_requests.give)
        application.router.add_get("/static/{path:.+}", self._file)
        application.on_response_prepare.append(protect)
        application.on_shutdown.append(self._close)
        application.on_cleanup.append(self._let_go)
        application.cleanup_ctx.append(self._reaching)
        application.cleanup_ctx.append(self._ticking)
        return application

    async def _outside(self, request: web.Request) -> web.Response:
        return web.Response(text="a room has a link of its own; ask whoever holds the meeting\n")

    async def _avatars(self, request: web.Request) -> web.Response:
        return web.json_response(self._files.names("avatars", ".glb"))

    async def _file(self, request: web.Request) -> web.Response:
        return await self._files.answer(request, request.match_info["path"])

    async def _health(self, request: web.Request) -> web.Response:
        return web.Response(text="well\n")

    async def _count(self, request: web.Request) -> web.Response:
        self._live_rooms.count(self.metrics)
        self.metrics.connections = self._sockets.count
        self.metrics.engines = sum(engine.up for engine in self._engines)
        self.metrics.redis = int(self._channels is not None and self._channels.connected)
        self.metrics.avatar_bytes = self._avatar_store.kept_bytes
        return web.Response(text=self.metrics.text())

    async def _page(self, request: web.Request) -> web.Response:
        if not ROOM_NAME.fullmatch(request.match_info["name"]):
            raise web.HTTPNotFound(text="no room has such a name\n")
        return await self._files.answer(request, "room.html")

    async def _place(self, request: web.Request) -> web.Response:
        """The room's floor, walls and chairs; without a key, as the page loads them while its person types."""
        own = self._places.get(request.match_info["name"]) or self._places.get("")
        return await (answer(request, own) if own else self._files.answer(request, f"places/{PLAIN}.glb"))

    async def _about(self, request: web.Request) -> web.Response:
        """What the page asks its person about before it comes in; needs no key, and says nothing of people."""
        recorder = self._live_rooms.recorder_of(request.match_info["name"])
        about = About(
            recording=recorder.id if recorder else "",
            replay=self._replayed is not None,
            engine=bool(self._engines),
        )
        return web.Response(text=about.model_dump_json(), content_type="application/json")

    async def _reaching(self, application: web.Application) -> AsyncIterator[None]:
        async with AsyncExitStack() as stack:
            for reached in (*self._engines, *([self._channels] if self._channels else ())):
                await stack.enter_async_context(reached.running(failed=self.stopped.set))
            yield

    async def _ticking(self, application: web.Application) -> AsyncIterator[None]:
        async with supervised(partial(self._live_rooms.tick, self.metrics), failed=self.stopped.set):
            yield

    async def _close(self, application: web.Application) -> None:
        await self._sockets.close()

    async def _let_go(self, application: web.Application) -> None:
        await self._avatar_requests.close()
