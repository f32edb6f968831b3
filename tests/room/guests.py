"""People who come to a room by a real WebSocket, for tests and for the benchmark."""

import asyncio
import secrets
from collections.abc import AsyncIterator, Callable, Coroutine, Sequence
from contextlib import asynccontextmanager, suppress
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from aiohttp import ClientSession, ClientWebSocketResponse, WSMsgType
from pydantic import Field, TypeAdapter

from room.places import Place as Scenery
from room.protocol import Message, decode, encode
from room.protocol.answers import Answer, Left, Refused, Welcome
from room.protocol.texts import Join
from room.protocol.tick import unpack
from room.recording import Recorder, check_recording
from room.server import Keys, Limits, Relays, Rooms, new_keys
from room.server.janus import Janus
from room.state import identity
from room.state.numbers import COLOURS
from tests.serving import serving

if TYPE_CHECKING:  # needs an extra of its own
    from room.server.redis_channels import RedisChannels

ANSWER = TypeAdapter(Annotated[Answer, Field(discriminator="kind")])
"""Reads what the room says."""

SOON_S = 120.0
"""What is awaited comes in milliseconds; a slow machine with other work is given time."""


class Guest:
    """One person: keeps what the room says to them."""

    def __init__(self, socket: ClientWebSocketResponse, secret: str) -> None:
        self.socket, self.secret = socket, secret
        self.answers: list[Answer] = []
        self.states: dict[int, Message] = {}
        self.sequences: list[tuple[int, int]] = []
        self.ticks = 0
        self.news = asyncio.Event()
        self.reading = asyncio.create_task(self._read())

    async def _read(self) -> None:
        async for message in self.socket:
            if message.type is WSMsgType.TEXT:
                self.answers.append(ANSWER.validate_json(message.data))
                if isinstance(self.answers[-1], Left):
                    self.states.pop(self.answers[-1].number, None)
            elif message.type is WSMsgType.BINARY:
                self.ticks += 1
                _, states = unpack(message.data)
                self.sequences += [(number, decode(content).sequence) for number, content in states]
                self.states |= {number: decode(content) for number, content in states}
            self.news.set()
        self.news.set()

    @property
    def welcome(self) -> Welcome:
        return next(answer for answer in self.answers if isinstance(answer, Welcome))

    @property
    def number(self) -> int:
        return self.welcome.number

    def all(self, kind: type) -> list:
        return [answer for answer in self.answers if isinstance(answer, kind)]

    async def until(self, true: Callable[[], object]) -> None:
        """Wait until something is so."""
        async with asyncio.timeout(SOON_S):
            while not true():
                await self.news.wait()
                self.news.clear()

    async def told(self, kind: type, which: Callable = lambda _: True) -> object:
        """Wait for a text, and give the newest of them."""
        await self.until(lambda: any(map(which, self.all(kind))))
        return [answer for answer in self.all(kind) if which(answer)][-1]

    async def say(self, **said: object) -> None:
        await self.socket.send_json(said)

    async def move(self, **state: object) -> None:
        await self.socket.send_bytes(encode(Message(**state)))

    async def end(self) -> tuple[int | None, list[Refused]]:
        """Wait until the room closes; gives the code, and the last word."""
        async with asyncio.timeout(SOON_S):
            await self.reading
        return self.socket.close_code, self.all(Refused)

    async def go(self) -> None:
        await self.socket.close()
        with suppress(asyncio.CancelledError):
            await self.reading


def secret_for(number: int) -> str:
    """A secret whose person gets this number, one of the first, where it is free."""
    while int(identity(secret := secrets.token_urlsafe(16)), 16) % COLOURS != number:
        pass
    return secret


class Place:
    """A room to come to, wherever it is served."""

    def __init__(self, address: str, keys: Keys, name: str = "meeting") -> None:
        self.address, self.keys, self.name = address, keys, name
        self.session, self.recording = ClientSession(), ""

    def join(self, **change: object) -> Join:
        made = Join(
            key=self.keys.key(self.name, "guest"),
            secret=secrets.token_urlsafe(16),
            name="Ada",
            recording=self.recording,
        )
        return made.model_copy(update=change)

    async def connect(self, **options: object) -> ClientWebSocketResponse:
        return await self.session.ws_connect(
            f"{self.address}/room/{self.name}/socket", max_msg_size=0, **options
        )

    async def come(self, *, moderator: bool = False, **change: object) -> Guest:
        """Open a connection and say who comes; does not wait for the answer."""
        if moderator:
            change["key"] = self.keys.key(self.name, "moderator")
        join = self.join(**change)
        socket = await self.connect()
        await socket.send_str(join.model_dump_json())
        return Guest(socket, join.secret)

    async def guest(self, **change: object) -> Guest:
        """Come in."""
        guest = await self.come(**change)
        await guest.told(Welcome)
        return guest


@asynccontextmanager
async def open_room(
    *,
    limits: Limits | None = None,
    relays: Relays | None = None,
    origins: frozenset[str] = frozenset(),
    keys: Keys | None = None,
    port: int = 0,
    recorder: Recorder | None = None,
    replayed: Path | None = None,
    channels: "RedisChannels | None" = None,
    engines: Sequence[Janus] = (),
    places: dict[str, Scenery] | None = None,
) -> AsyncIterator[Place]:
    """A server in this process, on a free port unless one is named."""
    keys = keys or new_keys()
    rooms = Rooms(
        keys,
        limits=limits or Limits(),
        relays=relays or Relays(),
        origins=origins,
        recorder=recorder,
        replayed=check_recording(replayed) if replayed else None,
        channels=channels,
        engines=engines,
        places=places,
    )
    try:
        async with serving(rooms.application(), port) as port:
            place = Place(f"http://127.0.0.1:{port}", keys)
            place.recording = recorder.id if recorder else ""
            try:
                yield place
            finally:
                await place.session.close()
    finally:
        if recorder:
            recorder.close()


def meeting(scenario: Callable[[Place], Coroutine]) -> Callable[[], None]:
    """Run a scenario in a room of its own."""

    @wraps(scenario)
    def test() -> None:
        async def run() -> None:
            async with open_room() as place:
                await scenario(place)

        asyncio.run(run())

    del test.__wrapped__  # pytest reads arguments through it, and would look for a fixture
    return test
