"""Sends to one browser or program without ever letting the others wait for it."""

import asyncio
from collections import Counter, deque
from collections.abc import Callable
from dataclasses import dataclass

from aiohttp import web

from room.protocol.answers import Answer, Changed, Left, Refused, Signal
from room.server.limits import MOST_FROM_ONE_BYTES, MOST_QUEUED_BYTES, MOST_TICKS_QUEUED, MOST_UNSENT_BYTES
from room.server.metrics import Metrics

CLOSED_BY_RULE = 4001
"""WebSocket's close code of whoever was refused; the text before it says why."""

PARTING_S = 3.0
"""Time to read the last word; then the connection is cut."""

PATIENCE_S = 20.0
"""A text that waits for so long shows a connection too slow for its room: a welcome of 64 people takes a second."""

_TEXT_BYTES = 256
"""What a waiting text takes beside its characters."""

_LOOK_S = 0.02
"""Between looks whether what was written has gone."""


@dataclass(eq=False)
class _Waiting:
    """A text that waits; ``sender`` is the number of whoever caused it, ``changed`` of whom it tells how they are."""

    text: str
    since: float
    sender: object = None
    changed: int | None = None


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
    unsent
        Gives the bytes that were written and wait in this process.
    """

    def __init__(
        self,
        socket: web.WebSocketResponse,
        metrics: Metrics,
        *,
        cut: Callable[[], None] = lambda: None,
        unsent: Callable[[], int] = lambda: 0,
    ) -> None:
        self._socket, self._metrics, self.cut, self._unsent = socket, metrics, cut, unsent
        self._cutting: asyncio.TimerHandle | None = None
        self._texts: deque[_Waiting] = deque()
        self._bytes, self._bytes_from = 0, Counter[object]()
        self._newest: dict[int, _Waiting] = {}
        self._ticks: deque[bytes] = deque(maxlen=MOST_TICKS_QUEUED)
        self._wake = asyncio.Event()
        self._last: Refused | None = None
        self._writer = asyncio.create_task(self._write())

    def say(self, answer: Answer) -> None:
        """Send a text as soon as may be."""
        changed = answer.person.number if isinstance(answer, Changed) else None
        waiting = None if changed is None else self._newest.get(changed)
        text = answer.model_dump_json(exclude_none=True)
        if waiting:  # how somebody is now says more than how they were
            self._bytes += len(text) - len(waiting.text)
            waiting.text = text
            return
        if isinstance(answer, Left):
            self._newest.pop(answer.number, None)
        self._append(_Waiting(text, asyncio.get_running_loop().time(), changed=changed))

    def pass_on(self, signal: Signal) -> None:
        """Send what another person's browser says, unless too much of that person waits: it is dropped then.

        Who floods somebody whose network is slow would else have the room close that connection.
        """
        text = signal.model_dump_json(exclude_none=True)
        if self._bytes_from[signal.sender] + _size(text) > MOST_FROM_ONE_BYTES:
            return
        if isinstance(signal.sender, int):
            self._newest.pop(signal.sender, None)  # what is said of them later stays behind this
        self._append(_Waiting(text, asyncio.get_running_loop().time(), sender=signal.sender))

    def _append(self, waiting: _Waiting) -> None:
        late = bool(self._texts) and waiting.since - self._texts[0].since > PATIENCE_S
        if late or self._bytes + _size(waiting.text) > MOST_QUEUED_BYTES:
            if self._last is None:
                self._metrics.slow += 1
            self.refuse("your connection is too slow for this room", again=True)
            return
        self._texts.append(waiting)
        self._bytes += _size(waiting.text)
        if waiting.sender is not None:
            self._bytes_from[waiting.sender] += _size(waiting.text)
        if waiting.changed is not None:
            self._newest[waiting.changed] = waiting
        self._wake.set()

    def _next(self) -> str:
        waiting = self._texts.popleft()
        self._bytes -= _size(waiting.text)
        if waiting.sender is not None:
            self._bytes_from[waiting.sender] -= _size(waiting.text)
        if waiting.changed is not None and self._newest.get(waiting.changed) is waiting:
            del self._newest[waiting.changed]
        return waiting.text

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
                    await self._socket.send_str(self._next())
                    await self._gone()
                while self._ticks and not self._texts and self._last is None:
                    content = self._ticks.popleft()
                    await self._socket.send_bytes(content)
                    self._metrics.ticks_sent += 1
                    self._metrics.bytes_sent += len(content)
                    await self._gone()
                if self._texts or self._ticks:
                    self._wake.set()
            await self._socket.send_str(self._last.model_dump_json())
            await self._socket.close(code=CLOSED_BY_RULE, message=b"refused")
        except ConnectionError:  # the other end has gone: whoever reads from it sees the same
            return

    async def _gone(self) -> None:
        """Wait until the network has taken nearly all: what waits here can still be dropped for something newer."""
        while self._unsent() > MOST_UNSENT_BYTES and self._last is None:
            await asyncio.sleep(_LOOK_S)


def _size(text: str) -> int:
    return len(text) + _TEXT_BYTES
