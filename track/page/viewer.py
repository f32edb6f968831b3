"""One browser's tab that looks: it gets the newest frame, however slow it is."""

import asyncio
from collections import deque

from aiohttp import web

UNSEEN_FRAMES = 2
"""Frames on their way to a tab that says what it has seen: one is drawn while the next one travels."""


class Viewer:
    """Sends a tab what is newest, and never more than it takes.

    A tab that tells by ``seen`` what it has drawn is `UNSEEN_FRAMES` behind at most; of one that never tells only the
    system's buffers are filled. What came in between is lost on purpose.

    Attributes
    ----------
    pictures
        Whether the tab wants the cameras' pictures.
    """

    def __init__(self, socket: web.WebSocketResponse) -> None:
        self.socket = socket
        self.pictures = False
        self._frame: tuple[int, str] | None = None
        self._coded: dict[int, bytes] = {}
        self._travelling: deque[int] = deque()
        self._tells = False
        self._changed = asyncio.Event()

    def offer(self, number: int, text: str, coded: dict[int, bytes]) -> None:
        """Replace what has not been sent by a newer frame, and pictures by those of the same cameras."""
        self._frame = number, text
        if self.pictures:
            self._coded.update(coded)
        self._changed.set()

    def has_seen(self, number: int) -> None:
        """Take note that the tab drew up to this frame."""
        self._tells = True
        while self._travelling and self._travelling[0] <= number:
            self._travelling.popleft()
        self._changed.set()

    async def send_newest(self) -> None:
        """Send until the tab has gone."""
        try:
            while True:
                await self._changed.wait()
                self._changed.clear()
                if self._frame is None or (self._tells and len(self._travelling) >= UNSEEN_FRAMES):
                    continue
                (number, text), self._frame = self._frame, None
                coded, self._coded = self._coded, {}
                self._travelling.append(number)
                if not self._tells and len(self._travelling) > UNSEEN_FRAMES:
                    self._travelling.popleft()
                await self.socket.send_str(text)
                for camera, picture in coded.items():
                    await self.socket.send_bytes(bytes([camera]) + picture)
        except ConnectionError:
            return  # the reader of the same socket ends as well
