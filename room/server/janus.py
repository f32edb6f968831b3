"""Speaks with one instance of Janus, which passes voices on, and comes back by itself when Janus was gone."""

import asyncio
import secrets
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from urllib.parse import urlsplit

from aiohttp import ClientError, ClientSession, ClientTimeout, ClientWebSocketResponse, WSMsgType
from pydantic import ValidationError

from room.errors import InputError
from room.server.janus_words import Jsep, Word
from room.server.supervised import supervised

MOST_WORD_BYTES = 1024**2
"""Of one message of Janus: the lines of a hundred voices with all their addresses have 0.1 MB."""

ALIVE_S = 15.0
"""Janus ends a session that was silent for a minute, unless it is set otherwise."""

REACH_S = 5.0
"""Time to connect and to be answered; then this Janus counts as gone."""

WAITS_S = (0.2, 0.5, 1.0)
"""Between tries to come back; the last one stays."""


class EngineGone(Exception):
    """Janus does not answer, or refuses what this server asks of it."""


Heard = Callable[[Word], None]
Body = dict[str, object]
"""A request, as Janus has it."""


class Janus:
    """One instance.

    Parameters
    ----------
    url
        Of its WebSockets, ``ws://HOST:8188``, as this server reaches it; browsers never do.
    secret
        Its ``api_secret``; empty where it has none.
    said
        Called with a sentence when it is gone, and when it is back.

    Raises
    ------
    InputError
        If the address is none.
    """

    def __init__(self, url: str, *, secret: str = "", said: Callable[[str], None] = lambda _: None) -> None:
        try:
            parts = urlsplit(url)
            sound = parts.scheme in ("ws", "wss") and bool(parts.hostname) and parts.port != 0
        except ValueError:  # half an IPv6 address, or a port beyond 65535
            sound = False
        if not sound:
            raise InputError(f"--janus {url!r}: is no address of a Janus; ws://HOST:8188 is one")
        self.url, self._secret, self._said = url, secret, said
        self.up = False
        self.watchers: set[Callable[[bool], None]] = set()
        self._socket: ClientWebSocketResponse | None = None
        self._session = 0
        self._heard: dict[int, Heard] = {}
        self._asked: dict[str, asyncio.Future[Word]] = {}
        self._told_gone = False

    @asynccontextmanager
    async def running(self, *, failed: Callable[[], None]) -> AsyncIterator[None]:
        """Stay connected until the context ends; ``failed`` is called if that ends by a fault of this program."""
        async with supervised(self._stay, failed=failed):
            yield

    async def attach(self, heard: Heard) -> int:
        """A new handle of the video room; ``heard`` is called with what Janus tells it unasked.

        Raises
        ------
        EngineGone
            If Janus does not answer.
        """
        word = await self._ask({"janus": "attach", "plugin": "janus.plugin.videoroom"})
        if word.data is None:
            raise EngineGone("Janus gives no handle")
        self._heard[word.data.id] = heard
        return word.data.id

    async def ask(self, handle: int, body: Body, jsep: Jsep | None = None) -> Word:
        """Ask the room something, and wait for its answer, which may be a refusal (``error_code``).

        Raises
        ------
        EngineGone
            If Janus does not answer.
        """
        asked: Body = {"janus": "message", "handle_id": handle, "body": body}
        return await self._ask(asked | ({"jsep": jsep.model_dump()} if jsep else {}), acknowledged=False)

    async def trickle(self, handle: int, candidate: Body) -> None:
        """Tell an address of a browser.

        Raises
        ------
        EngineGone
            If Janus does not answer.
        """
        await self._ask({"janus": "trickle", "handle_id": handle, "candidate": candidate})

    def detach(self, handle: int) -> None:
        """Let a handle go; its lines end."""
        if self._heard.pop(handle, None) and self.up:
            self._parting = asyncio.ensure_future(self._let_go(handle))

    async def _let_go(self, handle: int) -> None:
        try:
            await self._ask({"janus": "detach", "handle_id": handle})
        except EngineGone:
            return

    async def _ask(self, message: Body, *, acknowledged: bool = True) -> Word:
        """Ask, and wait for the answer: the acknowledgement, or what comes after it."""
        socket, transaction = self._socket, ("a" if acknowledged else "b") + secrets.token_hex(8)
        if socket is None:
            raise EngineGone("Janus is not reached")
        answered: asyncio.Future[Word] = asyncio.get_running_loop().create_future()
        self._asked[transaction] = answered
        if self._session:
            message = message | {"session_id": self._session}
        if self._secret:
            message = message | {"apisecret": self._secret}
        try:
            await socket.send_json(message | {"transaction": transaction})
            word = await asyncio.wait_for(answered, REACH_S)
        except (ConnectionError, ClientError, asyncio.TimeoutError):
            raise EngineGone("Janus does not answer") from None
        finally:
            self._asked.pop(transaction, None)
        if word.error:
            raise EngineGone(f"Janus refuses: {word.error.reason}")
        return word

    async def _stay(self) -> None:
        tries = 0
        while True:
            reason = "the connection ended"
            try:
                async with ClientSession(timeout=ClientTimeout(total=None, connect=REACH_S)) as session:
                    async with session.ws_connect(
                        self.url,
                        protocols=("janus-protocol",),
                        max_msg_size=MOST_WORD_BYTES,
                        heartbeat=REACH_S,
                    ) as socket:
                        tries = 0
                        await self._live(socket)
            except (ClientError, OSError, asyncio.TimeoutError, EngineGone) as error:
                reason = str(error) or "no answer in time"
            if not self._told_gone:
                self._told_gone = True
                self._said(f"{self.url}: is away ({reason}); its rooms have no voices until it is back")
            await asyncio.sleep(WAITS_S[min(tries, len(WAITS_S) - 1)])
            tries += 1

    def _tell(self, up: bool) -> None:
        self.up = up
        if up and self._told_gone:
            self._told_gone = False
            self._said(f"{self.url}: is back")
        for watcher in list(self.watchers):
            watcher(up)

    async def _live(self, socket: ClientWebSocketResponse) -> None:
        """From a connection that was opened to its end."""
        self._socket, self._session = socket, 0
        reading = asyncio.create_task(self._read(socket))
        try:
            made = await self._ask({"janus": "create"})
            if made.data is None:
                raise EngineGone("Janus gives no session")
            self._session = made.data.id
            self._tell(True)
            while not reading.done():
                await asyncio.wait({reading}, timeout=ALIVE_S)
                if not reading.done():
                    await self._ask({"janus": "keepalive"})
        finally:
            self._socket = None
            reading.cancel()
            await asyncio.gather(reading, return_exceptions=True)
            for answered in self._asked.values():
                if not answered.done():
                    answered.set_exception(ConnectionError())
            self._heard.clear()
            if self.up:
                self._tell(False)

    async def _read(self, socket: ClientWebSocketResponse) -> None:
        async for message in socket:
            if message.type is not WSMsgType.TEXT:
                continue
            try:
                word = Word.model_validate_json(message.data)
            except ValidationError:
                continue  # of a plugin or a version that says more than rooms ask for
            if word.janus == "timeout":
                return
            answered = self._asked.get(word.transaction or "")
            if answered is not None:
                # what a room is asked is acknowledged at once, and answered later
                if not answered.done() and (word.janus != "ack" or (word.transaction or "").startswith("a")):
                    answered.set_result(word)
            elif word.sender is not None and (heard := self._heard.get(word.sender)):
                heard(word)
