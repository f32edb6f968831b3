"""Sends to one browser or program without ever letting the others wait for it."""

import asyncio
from collections import deque
from collections.abc import Callable

from aiohttp import web

from room.protocol.answers import Answer, Refused
from room.server.limits import MOST_QUEUED, MOST_TICKS_QUEUED
from room.server.metrics import Metrics

CLOSED_BY_RULE = 4001
"""WebSocket's close code of whoever was refused; the text before it says why."""

PARTING_S = 3.0
"""Time to read the last word; then the connection is cut."""


class Connection:
    """One open WebSocket, and what waits to be sent on it.

    Parameters
    ----------
    socket
        Open.
    metrics
        Counts what is sent, and what was dropped.
    cut
        Ends the connection whatever waits on it: who reads nothing would never see a close.
    """

    def __init__(
        self, socket: web.WebSocketResponse, metrics: Metrics, *, cut: Callable[[], None] = lambda: None
    ) -> None:
        self._socket, self._metrics, self.cut = socket, metrics, cut
        self._cutting: asyncio.TimerHandle | None = None
        self._texts: deque[str] = deque()
        self._ticks: deque[bytes] = deque(maxlen=MOST_TICKS_QUEUED)
        self._wake = asyncio.Event()
        self._last: Refused | None = None
        self._writer = asyncio.create_task(self._write())

    def say(self, answer: Answer) -> None:
        """Send a text as soon as may be."""
        if len(self._texts) >= MOST_QUEUED:
            self._metrics.slow += 1
            self.refuse("your connection is too slow for this room", again=True)
            return
        self._texts.append(answer.model_dump_json(exclude_none=True))
        self._wake.set()

    def tick(self, content: bytes) -> None:
        """Send a tick, unless newer ones come before it can go."""
        self._metrics.ticks_dropped += len(self._ticks) == MOST_TICKS_QUEUED
        self._ticks.append(content)
        self._wake.set()

    def refuse(self, text: str, *, again: bool) -> None:
        """Say why, and close; what waited is dropped."""
        if self._last is None:
            self._last = Refused(text=text, again=again)
            self._wake.set()
            self._cutting = asyncio.get_running_loop().call_later(PARTING_S, self.cut)

    async def close(self) -> None:
        """Stop sending, without a word."""
        if self._cutting is not None:
            self._cutting.cancel()
        self._writer.cancel()
        await asyncio.gather(self._writer, return_exceptions=True)

    async def _write(self) -> None:
        try:
            while self._last is None:
                await self._wake.wait()
                self._wake.clear()
                while self._texts and self._last is None:
                    await self._socket.send_str(self._texts.popleft())
                while self._ticks and self._last is None:
                    content = self._ticks.popleft()
                    await self._socket.send_bytes(content)
                    self._metrics.ticks_sent += 1
                    self._metrics.bytes_sent += len(content)
            await self._socket.send_str(self._last.model_dump_json())
            await self._socket.close(code=CLOSED_BY_RULE, message=b"refused")
        except ConnectionError:  # the other end has gone: whoever reads from it sees the same
            return
