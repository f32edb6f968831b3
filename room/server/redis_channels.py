"""Sends messages between the processes of one server over Redis, and reconnects by itself when Redis was gone.

Redis keeps nothing of it: channels of publish and subscribe alone (https://redis.io/docs/latest/develop/interact/pubsub/).
"""

import asyncio
import hashlib
import hmac
import secrets
from collections import deque
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress

from redis.asyncio import Redis
from redis.asyncio.client import PubSub
from redis.asyncio.retry import Retry
from redis.backoff import NoBackoff
from redis.exceptions import RedisError

from room.errors import InputError, NotAllowed
from room.server.supervised import supervised

MOST_WAITING = 1000
"""Messages of one room that wait to be published; older ones are dropped, as newer ones say more."""

REACH_S = 2.0
"""Time to connect, to be answered, and to hear one's own beat; then Redis counts as gone."""

WAITS_S = (0.1, 0.2, 0.5, 1.0)
"""Between tries to come back; the last one stays."""

Heard = Callable[[bytes], None]


class RedisChannels:
    """One process's connection to Redis.

    Parameters
    ----------
    url
        ``redis://HOST:PORT/NUMBER``, ``rediss://`` for TLS, ``unix://PATH``; with name and password in Redis' way.
    secret
        Of the keys: servers of other keys use other channels, though they have rooms of the same names.
    said
        Called with a sentence when Redis is gone, and when it is back.

    Raises
    ------
    InputError
        If the address is none.
    """

    def __init__(self, url: str, *, secret: bytes, said: Callable[[str], None] = lambda _: None) -> None:
        try:
            self._redis = Redis.from_url(
                url,
                socket_connect_timeout=REACH_S,
                socket_timeout=REACH_S,
                retry=Retry(NoBackoff(), 0),  # what is lost is said again by whoever listens here
            )
        except ValueError as error:
            raise InputError(
                f"--redis: is no address of a Redis ({error}); redis://HOST:6379/0 is one"
            ) from None
        self.process = secrets.token_hex(8)
        self.connected = False
        self._mark = hmac.digest(secret, b"redis 1", hashlib.sha256).hex()[:32]
        self._said = said
        self._heard: dict[str, Heard] = {}
        self._confirmed: dict[str, asyncio.Event] = {}
        self._waiting: dict[str, deque[bytes]] = {}
        self._wake = asyncio.Event()
        self._subscription: PubSub | None = None
        self._told_gone = ""
        self._tried = asyncio.Event()

    @asynccontextmanager
    async def running(self, *, failed: Callable[[], None]) -> AsyncIterator[None]:
        """Hear and speak until the context ends; ``failed`` is called if that ends by a fault of this program."""
        try:
            async with supervised(self._listen, self._speak, failed=failed):
                yield
        finally:
            with suppress(RedisError, OSError):
                await self._redis.aclose()

    async def join(self, room: str, heard: Heard) -> None:
        """Hear what other processes say of a room, from when this returns; who comes at the start waits for Redis.

        Raises
        ------
        NotAllowed
            If Redis does not answer in time; nothing is heard then.
        """
        channel = self._channel(room)
        self._heard[channel] = heard
        confirmed = self._confirmed[channel] = asyncio.Event()
        try:
            await asyncio.wait_for(self._tried.wait(), REACH_S)
            if self._subscription is None or not self.connected:
                raise ConnectionError
            await self._subscription.subscribe(channel)
            await asyncio.wait_for(confirmed.wait(), REACH_S)
        except (RedisError, OSError, asyncio.TimeoutError):
            self.leave(room)
            raise NotAllowed("this room cannot be reached for a moment; coming back …", again=True) from None

    def listen(self, heard: Heard) -> None:
        """Hear what is said to this process alone, as of a room named ``/`` and `process`; call it before `running`."""
        self._heard[self._beat] = heard

    def leave(self, room: str) -> None:
        """Hear of a room no longer."""
        channel = self._channel(room)
        self._heard.pop(channel, None)
        self._confirmed.pop(channel, None)
        if self._subscription is not None and self.connected:
            self._parting = asyncio.ensure_future(self._part(self._subscription, channel))

    def say(self, room: str, content: bytes) -> None:
        """Say something to every process of a room, this one among them, soon and without waiting."""
        self._publish(self._channel(room), content)

    async def ask(self, room: str, content: bytes) -> int:
        """Say something at once; gives how many processes hear it, this one among them.

        Raises
        ------
        NotAllowed
            If Redis does not answer.
        """
        try:
            return int(await self._redis.publish(self._channel(room), content))
        except (RedisError, OSError):
            raise NotAllowed("this room cannot be reached for a moment; coming back …", again=True) from None

    def _channel(self, room: str) -> str:
        return f"room:1:{self._mark}:{room}"

    def _publish(self, channel: str, content: bytes) -> None:
        # of each room by itself: one that is flooded pushes nothing of the others out
        self._waiting.setdefault(channel, deque(maxlen=MOST_WAITING)).append(content)
        self._wake.set()

    async def _part(self, subscription: PubSub, channel: str) -> None:
        with suppress(RedisError, OSError):
            if channel not in self._heard:
                await subscription.unsubscribe(channel)

    async def _speak(self) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            batch, self._waiting = self._waiting, {}
            if not self.connected:
                continue  # what waited says less than what is said when Redis is back
            pipeline = self._redis.pipeline(transaction=False)
            for channel, contents in batch.items():
                for content in contents:
                    pipeline.publish(channel, content)
            with suppress(RedisError, OSError):  # whoever listens notices, and says so
                await pipeline.execute()

    async def _listen(self) -> None:
        tries = 0
        while True:
            try:
                async with self._redis.pubsub() as subscription:
                    await subscription.subscribe(self._beat, *self._heard)
                    beating = asyncio.create_task(self._beats())
                    try:
                        while message := await subscription.get_message(timeout=REACH_S):
                            if not self.connected:
                                self._subscription, self.connected, tries = subscription, True, 0
                                self._tell_back()
                            self._hear(message)
                    finally:
                        beating.cancel()
                reason = "it is silent"
            except (RedisError, OSError) as error:
                reason = str(error) or type(error).__name__
            self._subscription, self.connected = None, False
            self._tell_gone(reason)
            await asyncio.sleep(WAITS_S[min(tries, len(WAITS_S) - 1)])
            tries += 1

    @property
    def _beat(self) -> str:
        return self._channel(f"/{self.process}")

    async def _beats(self) -> None:
        """Say something to oneself: a Redis that has silently gone would else be waited for without end."""
        while True:
            await asyncio.sleep(REACH_S / 4)
            self._publish(self._beat, b"")

    def _hear(self, message: dict) -> None:
        channel = message["channel"].decode()
        if message["type"] == "subscribe" and channel in self._confirmed:
            self._confirmed[channel].set()
        elif message["type"] == "message" and channel in self._heard:
            self._heard[channel](message["data"])

    def _tell_gone(self, reason: str) -> None:
        self._tried.set()
        if (
            reason != self._told_gone
        ):  # one that has a wrong password is never back by itself: it must be read
            self._told_gone = reason
            self._said(
                f"redis is away ({reason}): open rooms go on in each server by itself, others open when it is back"
            )

    def _tell_back(self) -> None:
        self._tried.set()
        if self._told_gone:
            self._told_gone = ""
            self._said("redis is back: rooms are whole again")
