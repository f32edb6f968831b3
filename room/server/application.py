"""Answers requests: the page, its files, the WebSocket of each room, health and metrics."""

import asyncio
import re
import time
from collections.abc import AsyncIterator, Mapping, Sequence
from contextlib import AsyncExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from aiohttp import WSMessage, WSMsgType, web

from room.avatars import Wardrobe
from room.errors import FormatError, NotAllowed
from room.places import PLAIN, Place
from room.protocol.accounts import Part
from room.protocol.texts import MOST_TEXT_BYTES, About, Chat, Notice, read_join, read_said
from room.recording import Recorder, Survey
from room.server.carrier import Carrier
from room.server.connection import PARTING_S, Connection
from room.server.door import Door
from room.server.dressing import Dressing
from room.server.files import Files, answer, hold
from room.server.hall import HERTZ, Hall
from room.server.headers import protect, same_origin
from room.server.janus import Janus
from room.server.keys import Keys
from room.server.lasting import lasting
from room.server.limits import (
    BURST_S,
    CHATS_PER_S,
    STATES_PER_S,
    TEXTS_PER_S,
    Bucket,
    Limits,
)
from room.server.metrics import Metrics
from room.server.replay import Replay
from room.server.switchboard import Switchboard
from room.server.turn import Relays
from room.server.voices import instance_of, voice_room
from room.state import Seat

if TYPE_CHECKING:  # needs an extra of its own
    from room.server.telegraph import Telegraph

STATIC = Path(__file__).with_name("static")
"""What ``make web`` builds: the page, its script and the parts that it loads."""

ROOM_NAME = re.compile(r"[a-z0-9][a-z0-9-]{0,39}")
JOIN_S = 5.0
"""Time for the first text, after which a stranger's connection ends."""

HEARTBEAT_S = 8.0
"""A connection that answers no ping for half as long again has broken: its person is shown as away."""


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
    telegraph
        Reaches the other processes that carry the same rooms; None where this is the only one.
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
        telegraph: "Telegraph | None" = None,
        engines: Sequence[Janus] = (),
    ) -> None:
        self._telegraph, self._engines = telegraph, engines
        self._recorder, self._replayed = recorder, replayed
        self._keys, self._limits, self._relays, self._origins = keys, limits, relays, origins
        self._halls: dict[str, Hall] = {}
        self._opening: dict[str, asyncio.Task[None]] = {}
        self._sockets: set[web.WebSocketResponse] = set()
        self._door = Door()
        self._files = Files(STATIC)
        self._wardrobe = Wardrobe()
        self._carrier = Carrier(telegraph, self._wardrobe) if telegraph else None
        self._dressing = Dressing(keys, self._wardrobe, self._halls.get, origins)
        self._places = {room: hold(place.content, ".glb") for room, place in (places or {}).items()}
        self.metrics = Metrics()
        self.stopped = asyncio.Event()

    def application(self) -> web.Application:
        """Everything that is answered, and the ticks behind it."""
        application = web.Application(client_max_size=MOST_TEXT_BYTES)
        application.router.add_get("/", self._outside)
        application.router.add_get("/avatars.json", self._avatars)
        application.router.add_get("/health", self._health)
        application.router.add_get("/metrics", self._count)
        application.router.add_get("/room/{name}", self._page)
        application.router.add_get("/room/{name}/about.json", self._about)
        application.router.add_get("/room/{name}/place.glb", self._place)
        application.router.add_get("/room/{name}/socket", self._socket)
        application.router.add_post("/room/{name}/avatar", self._dressing.take)
        application.router.add_get("/room/{name}/avatar/{digest}", self._dressing.give)
        application.router.add_get("/static/{path:.+}", self._file)
        application.on_response_prepare.append(protect)
        application.on_shutdown.append(self._close)
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
        self.metrics.rooms = len(self._halls)
        self.metrics.people = sum(len(hall.meeting.people) for hall in self._halls.values())
        self.metrics.connections = len(self._sockets)
        self.metrics.engines = sum(engine.up for engine in self._engines)
        self.metrics.redis = int(self._telegraph is not None and self._telegraph.connected)
        self.metrics.avatar_bytes = self._wardrobe.kept_bytes
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
        about = About(
            recording=self._recorder_of(request.match_info["name"]) is not None,
            replay=self._replayed is not None,
            engine=bool(self._engines),
        )
        return web.Response(text=about.model_dump_json(), content_type="application/json")

    def _recorder_of(self, name: str) -> Recorder | None:
        recorder = self._recorder
        return recorder if recorder and recorder.room == name and recorder.open else None

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        name = request.match_info["name"]
        if not ROOM_NAME.fullmatch(name):
            raise web.HTTPNotFound(text="no room has such a name\n")
        if not same_origin(request, self._origins):
            self.metrics.refused += 1
            raise web.HTTPForbidden(text="another site's page may not come in\n")
        socket = web.WebSocketResponse(
            max_msg_size=MOST_TEXT_BYTES, heartbeat=HEARTBEAT_S, compress=False, timeout=1.0
        )
        await socket.prepare(request)
        transport = request.transport
        if transport is None:  # gone while it was answered
            return socket
        connection = Connection(socket, self.metrics, cut=transport.abort)
        self._sockets.add(socket)
        try:
            await self._meet(request, socket, connection)
        except (FormatError, NotAllowed) as error:
            self.metrics.refused += 1
            connection.refuse(str(error), again=isinstance(error, NotAllowed) and error.again)
            with suppress(asyncio.TimeoutError):
                await asyncio.wait_for(_ignore(socket), PARTING_S)
        finally:
            self._sockets.discard(socket)
            await connection.close()
        return socket

    async def _meet(
        self, request: web.Request, socket: web.WebSocketResponse, connection: Connection
    ) -> None:
        """Whatever somebody does from coming in to going.

        Raises
        ------
        FormatError
            If a message is none.
        NotAllowed
            If a rule ends the connection.
        """
        stranger = self._door.knock(request.remote, connection.cut)
        try:
            first = await socket.receive(timeout=JOIN_S)
        except asyncio.TimeoutError:
            raise NotAllowed(f"nothing was said for {JOIN_S:g} seconds", again=True) from None
        finally:
            self._door.pass_by(stranger)
        if first.type in (WSMsgType.CLOSE, WSMsgType.CLOSING, WSMsgType.CLOSED, WSMsgType.ERROR):
            return
        if first.type is not WSMsgType.TEXT:
            raise FormatError("the first message must be the text that says who comes in")
        join, name = read_join(first.data), request.match_info["name"]
        role = self._keys.role(name, join.key)
        if role is None:
            raise NotAllowed("this link is not, or no longer, one of this room; ask for a new one")
        hall = await self._hall(name)
        seat = hall.enter(join, connection, moderator=role == "moderator")
        try:
            await self._listen(hall, seat, join.role, socket, connection)
        finally:
            hall.go(seat, connection, join.role)

    async def _hall(self, name: str) -> Hall:
        """The room, which is opened for the first who comes; others who come meanwhile wait for the same."""
        while (hall := self._halls.get(name)) is None:  # a tick may close it before the first is in
            if name not in self._opening:
                if len(self._halls) + len(self._opening) >= self._limits.rooms:
                    raise NotAllowed(f"all {self._limits.rooms} rooms of this server are in use", again=True)
                opening = self._opening[name] = asyncio.create_task(self._open(name))
                opening.add_done_callback(lambda _: self._opening.pop(name))
            await asyncio.shield(self._opening[name])
        return hall

    async def _open(self, name: str) -> None:
        switchboard = self._switchboard(name)
        hall = Hall(
            name,
            most_people=self._limits.people,
            relays=self._relays,
            wardrobe=self._wardrobe,
            recorder=self._recorder_of(name),
            replay=Replay(self._replayed) if self._replayed else None,
            telegraph=self._telegraph,
            carrier=self._carrier,
            switchboard=switchboard,
        )
        try:
            await hall.open()
        except NotAllowed:
            if switchboard:
                switchboard.close()  # Janus would else tell it of every end and beginning, for ever
            raise
        self._halls[name] = hall

    def _switchboard(self, name: str) -> Switchboard | None:
        if not self._engines:
            return None
        # a person who comes back may stand in Janus's list a second time for a moment
        room = voice_room(self._keys.secret, name, places=2 * self._limits.people)
        return Switchboard(instance_of(name, self._engines), room)

    async def _listen(
        self, hall: Hall, seat: Seat, part: Part, socket: web.WebSocketResponse, connection: Connection
    ) -> None:
        states = Bucket(STATES_PER_S, burst=STATES_PER_S * BURST_S)
        texts = Bucket(TEXTS_PER_S, burst=TEXTS_PER_S * BURST_S)
        chats = Bucket(CHATS_PER_S, burst=CHATS_PER_S * BURST_S)
        message: WSMessage
        async for message in socket:
            now = time.monotonic()
            if not (states if message.type is WSMsgType.BINARY else texts).take(now=now):
                raise NotAllowed("too many messages; the page was closed", again=False)
            if hall.meeting.seat(seat.id) is not seat:
                continue  # removed: the word is on its way
            if message.type is WSMsgType.BINARY:
                self.metrics.states += 1
                hall.move(seat, message.data, part)
            elif message.type is WSMsgType.TEXT:
                self.metrics.texts += 1
                said = read_said(message.data)
                if part == "face":
                    raise NotAllowed("a program that moves a face sends states, and no texts")
                if isinstance(said, Chat) and not chats.take(now=now):
                    connection.say(Notice(text="that was too fast; the line was not sent"))
                    continue
                try:
                    hall.hear(seat, said)
                except NotAllowed as error:
                    connection.say(Notice(text=str(error)))

    async def _reaching(self, application: web.Application) -> AsyncIterator[None]:
        async with AsyncExitStack() as stack:
            for reached in (*self._engines, *([self._telegraph] if self._telegraph else ())):
                await stack.enter_async_context(reached.running(failed=self.stopped.set))
            yield

    async def _ticking(self, application: web.Application) -> AsyncIterator[None]:
        async with lasting(self._tick, failed=self.stopped.set):
            yield

    async def _tick(self) -> None:
        due = time.monotonic()
        while True:
            due += 1 / HERTZ
            await asyncio.sleep(due - time.monotonic())
            now = time.monotonic()
            self.metrics.late_s += now - due
            due = max(due, now - 1 / HERTZ)  # what was missed by more than a tick is not made up for
            for name, hall in list(self._halls.items()):
                hall.tick(now=now)
                if hall.empty:
                    hall.close()
                    del self._halls[name]

    async def _close(self, application: web.Application) -> None:
        # 1012, "service restart": pages come back by themselves
        closing = (socket.close(code=1012, message=b"the server stops") for socket in list(self._sockets))
        await asyncio.gather(*closing, return_exceptions=True)


async def _ignore(socket: web.WebSocketResponse) -> None:
    """Throw away what comes until the other end has read its last word."""
    async for _ in socket:
        pass
