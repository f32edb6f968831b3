"""Serves the page to browsers on this machine, in a thread of its own, and hands on what they ask for."""

import asyncio
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from pathlib import Path

from aiohttp import WSCloseCode, WSMsgType, web

from facegen.errors import InputError
from track.messages import Command, Moment
from track.page import frames
from track.page.commands import MOST_MESSAGE_BYTES, Seen, read_command
from track.page.guard import HEADERS, Guard
from track.page.viewer import Viewer

STATIC = Path(__file__).parent / "static"
FILES = {"/": "index.html", "/page.js": "page.js", "/page.css": "page.css", "/LICENSES.txt": "LICENSES.txt"}

MOST_VIEWERS = 8
"""Tabs that look at once: a person has two or three, and each costs a copy of all frames."""

PICTURES_PER_SECOND = 15
"""Of each camera: enough to see oneself; 30 would double the cost of what is only looked at in passing."""

FRAMES_PER_SECOND = 60
"""That a tab is told: screens draw no more, and a headset's 120 would take the session's time for it."""

HEARTBEAT_S = 20.0
"""After which a tab is asked whether it is still there; half of it later it is given up."""

CLOSE_S = 5.0
"""That `Page.close` waits for the thread."""


class Page:
    """The page's server; its thread starts at once and ends with `close`.

    Parameters
    ----------
    commands
        Called with each command of a browser, in the server's thread: it must take it and return. What it refuses by
        `InputError` is told to the tab that asked.
    host
        To listen on; with one that other machines reach, the link holds a token.
    port
        0 takes a free one.
    token
        To ask for; made where it is needed and missing.
    cameras
        Names, by which pictures and points are told apart; the first one's are the landmarks.
    steps
        Of calibration, by name.
    avatar
        A .glb or .vrm to begin with; the one that comes with track where there is none.

    Raises
    ------
    InputError
        The port is taken, the host is not this machine's, or the token could be guessed.
    """

    def __init__(
        self,
        commands: Callable[[Command], None],
        host: str = "127.0.0.1",
        port: int = 0,
        token: str | None = None,
        *,
        cameras: Sequence[str] = ("camera",),
        steps: Sequence[str] = ("neutral",),
        avatar: Path | None = None,
    ) -> None:
        self._commands = commands
        self._cameras, self._steps = tuple(cameras), tuple(steps)
        self._avatar = avatar or STATIC / "head.glb"
        self._guard = Guard.of(host, token)
        self._newest: Moment | None = None
        self._number, self._pictured_at, self._due_s = 0, -1.0, 0.0
        self._viewers: set[Viewer] = set()
        self._wants_pictures = False
        self._woken = False
        self._begun: Future[tuple[asyncio.AbstractEventLoop, asyncio.Event, int]] = Future()
        self._thread = threading.Thread(
            target=lambda: asyncio.run(self._serve(host, port)), name="track-page", daemon=True
        )
        self._thread.start()
        try:
            self._loop, self._end, self.port = self._begun.result()
        except OSError as error:
            why = error.strerror or str(error)
            raise InputError(
                f"the page cannot listen on {host}:{port} ({why}); choose another port, or 0 for a free one"
            ) from None

    @property
    def url(self) -> str:
        """The link to open on this machine; whoever has it may look."""
        host = self._guard.host
        shown = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)
        return f"http://{shown}:{self.port}/" + (f"?token={self._guard.token}" if self._guard.token else "")

    @property
    def is_shared(self) -> bool:
        """Whether other machines may look, who then see the cameras' pictures."""
        return self._guard.is_shared

    @property
    def watched(self) -> bool:
        """Whether a browser looks just now."""
        return bool(self._viewers)

    @property
    def wants_pictures(self) -> bool:
        """Whether one of them wants the cameras' pictures."""
        return self._wants_pictures

    def publish(self, moment: Moment) -> None:
        """Show a moment, from any thread; returns at once, and of several that wait the newest is shown."""
        self._newest = moment
        if self._woken or not self._viewers:
            return
        self._woken = True
        try:
            self._loop.call_soon_threadsafe(self._show_when_due)
        except RuntimeError:
            return  # closed in between

    def close(self) -> None:
        """Tell all tabs that it is over, and end the thread."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._end.set)
        self._thread.join(CLOSE_S)

    def __enter__(self) -> "Page":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    async def _serve(self, host: str, port: int) -> None:
        app = web.Application(middlewares=[self._judge])
        app.router.add_get("/stream", self._stream)
        app.router.add_get("/avatar", self._send_avatar)
        for path in FILES:
            app.router.add_get(path, self._send_file)
        app.on_response_prepare.append(_add_headers)
        runner = web.AppRunner(app, access_log=None, shutdown_timeout=1.0)
        await runner.setup()
        try:
            site = web.TCPSite(runner, host, port)
            try:
                await site.start()
            except (OSError, OverflowError, UnicodeError) as error:
                self._begun.set_exception(error if isinstance(error, OSError) else OSError(str(error)))
                return
            end = asyncio.Event()
            self._begun.set_result((asyncio.get_running_loop(), end, runner.addresses[0][1]))
            await end.wait()
            closing = (viewer.socket.close(code=WSCloseCode.GOING_AWAY) for viewer in self._viewers)
            await asyncio.gather(*closing)
        finally:
            await runner.cleanup()

    def _show_when_due(self) -> None:
        self._loop.call_later(max(0.0, self._due_s - time.perf_counter()), self._show)

    def _show(self) -> None:
        """Offer the newest moment to all tabs; in the server's loop."""
        self._woken, self._due_s = False, time.perf_counter() + 1 / FRAMES_PER_SECOND
        moment = self._newest
        if moment is None or not self._viewers:
            return
        self._number += 1
        text = frames.frame(moment, self._number, cameras=self._cameras)
        now, coded = time.perf_counter(), {}
        if self._wants_pictures and now - self._pictured_at >= 1 / PICTURES_PER_SECOND:
            self._pictured_at = now
            coded = {
                place: frames.jpeg(moment.pictures[name])
                for place, name in enumerate(self._cameras)
                if name in moment.pictures
            }
        for viewer in self._viewers:
            viewer.offer(self._number, text, coded)

    @web.middleware
    async def _judge(self, request: web.Request, handler: Callable) -> web.StreamResponse:
        objection = self._guard.objection(request)
        if objection is not None:
            raise web.HTTPForbidden(text=f"{objection}\n")
        return await handler(request)

    async def _send_file(self, request: web.Request) -> web.StreamResponse:
        return web.FileResponse(STATIC / FILES[request.path])

    async def _send_avatar(self, request: web.Request) -> web.StreamResponse:
        if not self._avatar.is_file():
            raise web.HTTPNotFound(text="there is no avatar yet\n")
        response = web.FileResponse(self._avatar)
        response.content_type = "model/gltf-binary"
        return response

    async def _stream(self, request: web.Request) -> web.StreamResponse:
        if len(self._viewers) >= MOST_VIEWERS:
            raise web.HTTPServiceUnavailable(text=f"{MOST_VIEWERS} tabs look already; close one\n")
        # weights do not become smaller by it, and pictures are compressed
        socket = web.WebSocketResponse(max_msg_size=MOST_MESSAGE_BYTES, heartbeat=HEARTBEAT_S, compress=False)
        try:
            await socket.prepare(request)
        except ConnectionError:  # gone while it was answered
            return web.Response()
        viewer = Viewer(socket)
        settings = self._newest.settings if self._newest is not None else {}
        sending = asyncio.create_task(viewer.send_newest())
        self._viewers.add(viewer)
        try:
            await socket.send_str(
                frames.hello(
                    cameras=self._cameras, steps=self._steps, settings=settings, shared=self.is_shared
                )
            )
            async for message in socket:
                await self._hear(viewer, message.data if message.type is WSMsgType.TEXT else "")
        except ConnectionError:
            pass  # gone while it was answered
        finally:
            self._viewers.discard(viewer)
            sending.cancel()
            self._ask_for_pictures()
        return socket

    async def _hear(self, viewer: Viewer, text: str) -> None:
        try:
            heard = read_command(text, steps=self._steps)
            if isinstance(heard, Seen):
                viewer.has_seen(heard.number)
            elif heard.verb == "picture":
                viewer.pictures = bool(heard.value)
                self._ask_for_pictures()
            else:
                self._commands(heard)
        except InputError as error:
            await viewer.socket.send_str(frames.refused(str(error)))

    def _ask_for_pictures(self) -> None:
        """Tell the session when the first tab wants pictures, and when the last one no longer does."""
        wanted = any(viewer.pictures for viewer in self._viewers)
        if wanted != self._wants_pictures:
            self._wants_pictures = wanted
            self._commands(Command(verb="picture", value=wanted))


async def _add_headers(request: web.Request, response: web.StreamResponse) -> None:
    response.headers.update(HEADERS)
