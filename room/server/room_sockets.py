"""Answers the WebSocket of each room: reads who joins, and then what they send until they go."""

import asyncio
import re
import time
from contextlib import suppress

from aiohttp import WSMessage, WSMsgType, web

from room.errors import FormatError, NotAllowed
from room.protocol.accounts import Part
from room.protocol.answers import Notice
from room.protocol.texts import MOST_TEXT_BYTES, Candidate, Chat, Description, read_join, read_said
from room.server.connection import PARTING_S, Connection
from room.server.headers import same_origin
from room.server.keys import Keys
from room.server.limits import (
    BURST_S,
    CHATS_PER_S,
    SIGNALS_A_PERSON,
    STATES_PER_S,
    TEXTS_PER_S,
    Bucket,
)
from room.server.live_room import LiveRoom
from room.server.live_rooms import LiveRooms
from room.server.metrics import Metrics
from room.server.network import hold_little
from room.server.pending_connections import PendingConnections
from room.state import Seat

ROOM_NAME = re.compile(r"[a-z0-9][a-z0-9-]{0,39}")
JOIN_S = 5.0
"""Time for the first text, after which a connection that has said nothing ends."""

AT_ONCE = 16
"""Messages of one connection that are heard before all others have their turn."""

HEARTBEAT_S = 8.0
"""A connection that answers no ping for half as long again has broken: its person is shown as away."""


class RoomSockets:
    """The connections of all rooms of a process.

    Parameters
    ----------
    keys
        Of all rooms.
    rooms
        Has the rooms.
    origins
        Of proxies in front of this server.
    metrics
        Counts what comes and goes.
    """

    def __init__(self, keys: Keys, rooms: LiveRooms, origins: frozenset[str], metrics: Metrics) -> None:
        self._keys, self._rooms, self._origins, self._metrics = keys, rooms, origins, metrics
        self._sockets: set[web.WebSocketResponse] = set()
        self._pending = PendingConnections()

    @property
    def count(self) -> int:
        """How many are open."""
        return len(self._sockets)

    async def close(self) -> None:
        """Tell all that the server stops."""
        # 1012, "service restart": pages come back by themselves
        closing = (socket.close(code=1012, message=b"the server stops") for socket in list(self._sockets))
        await asyncio.gather(*closing, return_exceptions=True)

    async def answer(self, request: web.Request) -> web.StreamResponse:
        """One connection, from its request to its end."""
        name = request.match_info["name"]
        if not ROOM_NAME.fullmatch(name):
            raise web.HTTPNotFound(text="no room has such a name\n")
        if not same_origin(request, self._origins):
            self._metrics.refused += 1
            raise web.HTTPForbidden(text="another site's page may not come in\n")
        socket = web.WebSocketResponse(
            max_msg_size=MOST_TEXT_BYTES, heartbeat=HEARTBEAT_S, compress=False, timeout=1.0
        )
        try:
            await socket.prepare(request)
        except ConnectionError:  # gone while it was answered
            return web.Response()
        transport = request.transport
        if transport is None:
            return socket
        hold_little(transport)
        connection = Connection(
            socket, self._metrics, cut=transport.abort, unsent=transport.get_write_buffer_size
        )
        self._sockets.add(socket)
        try:
            await self._meet(request, socket, connection)
        except (FormatError, NotAllowed) as error:
            self._metrics.refused += 1
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
        pending = self._pending.add(request.remote, connection.cut)
        try:
            first = await socket.receive(timeout=JOIN_S)
        except asyncio.TimeoutError:
            raise NotAllowed(f"nothing was said for {JOIN_S:g} seconds", again=True) from None
        finally:
            self._pending.remove(pending)
        if first.type in (WSMsgType.CLOSE, WSMsgType.CLOSING, WSMsgType.CLOSED, WSMsgType.ERROR):
            return
        if first.type is not WSMsgType.TEXT:
            raise FormatError("the first message must be the text that says who comes in")
        join, name = read_join(first.data), request.match_info["name"]
        role = self._keys.role(name, join.key)
        if role is None:
            raise NotAllowed("this link is not, or no longer, one of this room; ask for a new one")
        room = await self._rooms.open(name)
        seat = room.enter(join, connection, moderator=role == "moderator")
        try:
            await self._listen(room, seat, join.role, socket, connection)
        finally:
            room.go(seat, connection, join.role)

    async def _listen(
        self, room: LiveRoom, seat: Seat, part: Part, socket: web.WebSocketResponse, connection: Connection
    ) -> None:
        states = Bucket(STATES_PER_S, burst=STATES_PER_S * BURST_S)
        texts = Bucket(TEXTS_PER_S, burst=TEXTS_PER_S * BURST_S)
        chats = Bucket(CHATS_PER_S, burst=CHATS_PER_S * BURST_S)
        signals = Bucket(
            TEXTS_PER_S, burst=TEXTS_PER_S * BURST_S + SIGNALS_A_PERSON * room.meeting.most_people
        )
        message: WSMessage
        heard = 0
        async for message in socket:
            heard += 1
            if not heard % AT_ONCE:
                # what has arrived is given without a pause: whom it is for could take none of it
                await asyncio.sleep(0)
            now = time.monotonic()
            said = read_said(message.data) if message.type is WSMsgType.TEXT else None
            calls = isinstance(said, Description | Candidate)
            if not (signals if calls else texts if said else states).take(now=now):
                raise NotAllowed("too many messages; the page was closed", again=False)
            if room.meeting.seat(seat.id) is not seat:
                continue  # removed: the word is on its way
            if message.type is WSMsgType.BINARY:
                self._metrics.states += 1
                room.move(seat, message.data, part)
            elif said:
                self._metrics.texts += 1
                if part == "face":
                    raise NotAllowed("a program that moves a face sends states, and no texts")
                if isinstance(said, Chat) and not chats.take(now=now):
                    connection.say(Notice(text="that was too fast; the line was not sent", about=said.kind))
                    continue
                try:
                    room.hear(seat, said)
                except NotAllowed as error:
                    connection.say(Notice(text=str(error), about=said.kind))


async def _ignore(socket: web.WebSocketResponse) -> None:
    """Throw away what comes until the other end has read its last word."""
    async for _ in socket:
        pass
