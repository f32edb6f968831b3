"""A camera on the network: MJPEG over HTTP from a thread of its own, with the manners of several makers."""

import asyncio
import base64
import contextlib
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import cv2
import numpy as np
from aiohttp import web

from tests.serving import serving

MANNERS: dict[str, tuple[str, bytes]] = {
    "plain": (
        "multipart/x-mixed-replace; boundary=frame",
        b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %(length)d\r\n\r\n%(jpeg)s\r\n",
    ),
    # esp32-camera's camera_web_server example
    "esp32": (
        "multipart/x-mixed-replace;boundary=123456789000000000000987654321",
        b"\r\n--123456789000000000000987654321\r\nContent-Type: image/jpeg\r\nContent-Length: %(length)d\r\n"
        b"X-Timestamp: 12.345678\r\n\r\n%(jpeg)s",
    ),
    "dashes in the header": (
        "multipart/x-mixed-replace; boundary=--frame",
        b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %(length)d\r\n\r\n%(jpeg)s\r\n",
    ),
    "quoted": (
        'multipart/x-mixed-replace; boundary="frame"',
        b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %(length)d\r\n\r\n%(jpeg)s\r\n",
    ),
    "another boundary than told": (
        "multipart/x-mixed-replace; boundary=told",
        b"--sent\r\nContent-Type: image/jpeg\r\nContent-Length: %(length)d\r\n\r\n%(jpeg)s\r\n",
    ),
    "lower case, bare line feeds": (
        "multipart/x-mixed-replace; boundary=frame",
        b"--frame\ncontent-type: image/jpeg\ncontent-length: %(length)d\n\n%(jpeg)s\n",
    ),
    "no boundary told": (
        "multipart/x-mixed-replace",
        b"--frame\r\nContent-Type: image/jpeg\r\nContent-Length: %(length)d\r\n\r\n%(jpeg)s\r\n",
    ),
    "no length": (
        "multipart/x-mixed-replace; boundary=frame",
        b"--frame\r\nContent-Type: image/jpeg\r\n\r\n%(jpeg)s\r\n",
    ),
    "bare pictures": ("video/x-motion-jpeg", b"%(jpeg)s"),
}
"""Content type, and what stands around each picture: its length, then its bytes."""


@dataclass
class MjpegServer:
    """What the camera does just now; tests change it while it runs."""

    picture: Callable[[int], np.ndarray]
    manners: str = "plain"
    fps: float = 30.0
    password: str | None = None
    stopped: bool = False
    port: int = 0
    sent: int = 0
    asked: int = 0

    async def stream(self, request: web.Request) -> web.StreamResponse:
        self.asked += 1
        given = request.headers.get("Authorization", "")
        wanted = None if self.password is None else base64.b64encode(f"me:{self.password}".encode()).decode()
        if wanted is not None and given != f"Basic {wanted}":
            return web.Response(status=401, headers={"WWW-Authenticate": 'Basic realm="camera"'})
        content_type, around = MANNERS[self.manners]
        response = web.StreamResponse(headers={"Content-Type": content_type})
        await response.prepare(request)
        with contextlib.suppress(ConnectionError):
            while not self.stopped:
                jpeg = cv2.imencode(".jpg", self.picture(self.sent))[1].tobytes()
                await response.write(around % {b"length": len(jpeg), b"jpeg": jpeg})
                self.sent += 1
                await asyncio.sleep(1 / self.fps)
        return response


@contextlib.contextmanager
def mjpeg_server(server: MjpegServer) -> Iterator[MjpegServer]:
    """Serve until the block ends; ``port`` is set by then, and stays if it was given."""
    loop, ready = asyncio.new_event_loop(), threading.Event()
    over = asyncio.Event()

    async def serve() -> None:
        app = web.Application()
        app.router.add_get("/stream", server.stream)
        async with serving(app, server.port) as server.port:
            ready.set()
            await over.wait()

    thread = threading.Thread(target=loop.run_until_complete, args=[serve()])
    thread.start()
    try:
        assert ready.wait(60)
        yield server
    finally:
        server.stopped = True
        loop.call_soon_threadsafe(over.set)
        thread.join()
        loop.close()
