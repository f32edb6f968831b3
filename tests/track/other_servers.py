"""MJPEG as servers of other makes write it: Python's own http.server, and aiohttp's writer of multipart messages."""

import asyncio
import contextlib
import threading
import time
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import aiohttp
import cv2
from aiohttp import web

from tests.serving import serving
from tests.track.virtual import noise


def _jpeg(number: int) -> bytes:
    return cv2.imencode(".jpg", noise(number))[1].tobytes()


@contextlib.contextmanager
def http_server() -> Iterator[int]:
    """Python's http.server: HTTP/1.0, a thread for each who looks, no length of the whole; gives the port."""
    over = threading.Event()

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.send_header("Content-Type", "multipart/x-mixed-replace; boundary=jpgboundary")
            self.end_headers()
            number = 0
            with contextlib.suppress(ConnectionError):
                while not over.is_set():
                    jpeg, number = _jpeg(number), number + 1
                    self.wfile.write(b"--jpgboundary\r\n")
                    self.send_header("Content-type", "image/jpeg")
                    self.send_header("Content-length", str(len(jpeg)))
                    self.end_headers()
                    self.wfile.write(jpeg)
                    time.sleep(0.01)

        def log_message(self, *_: object) -> None:
            """Say nothing."""

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        thread = threading.Thread(target=server.serve_forever, args=[0.05])
        thread.start()
        try:
            yield server.server_port
        finally:
            over.set()
            server.shutdown()
            thread.join()


@contextlib.contextmanager
def aiohttp_server() -> Iterator[int]:
    """aiohttp's MultipartWriter in HTTP/1.1's chunks, each part with headers of its own choice; gives the port."""
    loop, over, ports = asyncio.new_event_loop(), asyncio.Event(), []
    ready = threading.Event()

    async def stream(request: web.Request) -> web.StreamResponse:
        headers = {"Content-Type": "multipart/x-mixed-replace; boundary=made-by-aiohttp"}
        response = web.StreamResponse(headers=headers)
        await response.prepare(request)
        number = 0
        with contextlib.suppress(ConnectionError):
            while not over.is_set():
                with aiohttp.MultipartWriter("image/jpeg", boundary="made-by-aiohttp") as writer:
                    writer.append(_jpeg(number), {"Content-Type": "image/jpeg"})
                number += 1
                await writer.write(response, close_boundary=False)
                await asyncio.sleep(0.01)
        return response

    async def serve() -> None:
        app = web.Application()
        app.router.add_get("/stream", stream)
        async with serving(app) as port:
            ports.append(port)
            ready.set()
            await over.wait()

    thread = threading.Thread(target=loop.run_until_complete, args=[serve()])
    thread.start()
    try:
        assert ready.wait(60)
        yield ports[0]
    finally:
        loop.call_soon_threadsafe(over.set)
        thread.join()
        loop.close()


SERVERS = {"http.server": http_server, "aiohttp": aiohttp_server}
