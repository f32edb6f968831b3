"""A headless Chromium for tests, spoken to by DevTools' own protocol: it opens pages, asks them things, draws them.

References
----------
.. [1] https://chromedevtools.github.io/devtools-protocol/
"""

import asyncio
import base64
import itertools
import shutil
import subprocess
import tempfile
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from pathlib import Path

import aiohttp
import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
needs_chromium = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")

OPTIONS = (
    *("--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--disable-extensions", "--hide-scrollbars"),
    *("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-port=0"),
)
START_S = 120.0
"""A browser on a busy machine begins to listen within five; one that is slow as well is given time."""
ANSWER_S = 180.0
"""Shaders are compiled in software the first time: two seconds, or twenty on a busy machine."""
PATIENCE_S = 120.0
"""What a page is to do it does in a second; that a machine is slow and has other work is no fault of the page."""


class Tab:
    """One page that is open.

    Attributes
    ----------
    complaints
        What the page wrote to its console as a warning or an error, threw, or was refused.
    asked
        Addresses of all that it requested, WebSockets among them.
    """

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        self.complaints: list[str] = []
        self.asked: list[str] = []
        self._socket = socket
        self._numbers = itertools.count(1)
        self._answers: dict[int, asyncio.Future] = {}

    async def call(self, method: str, **parameters: object) -> dict:
        """A method of DevTools, and its result."""
        number = next(self._numbers)
        self._answers[number] = asyncio.get_running_loop().create_future()
        await self._socket.send_json({"id": number, "method": method, "params": parameters})
        answer = await asyncio.wait_for(self._answers[number], ANSWER_S)
        assert "error" not in answer, answer
        return answer["result"]

    async def ask(self, script: str) -> object:
        """The value of an expression in the page; of a promise, what it gives."""
        answer = await self.call(
            "Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True, userGesture=True
        )
        assert "exceptionDetails" not in answer, answer["exceptionDetails"]
        return answer["result"].get("value")

    async def until(self, script: str, seconds: float = PATIENCE_S) -> None:
        """Wait for an expression to become true."""
        end = time.monotonic() + seconds
        while not await self.ask(f"Boolean({script})"):
            assert time.monotonic() < end, f"{script} stays false; complaints: {self.complaints}"
            await asyncio.sleep(0.05)

    async def drawn(self, pictures: int) -> None:
        """Wait until so many pictures of the page were drawn; of one that is behind another none is."""
        await self.ask(
            f"void (globalThis.due = {pictures},"
            " (function next() { requestAnimationFrame(() => --globalThis.due && next()); })())"
        )
        await self.until("globalThis.due === 0")

    async def look(self, *, width: int, height: int, dark: bool = False, telephone: bool = False) -> None:
        """Make the window so large, in a light or a dark scheme."""
        await self.call(
            "Emulation.setDeviceMetricsOverride",
            **{"width": width, "height": height, "deviceScaleFactor": 1, "mobile": telephone},
        )
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        await self.call("Emulation.setEmulatedMedia", features=[scheme])

    async def picture(self, path: Path, *, whole: bool = False) -> None:
        """Write what is seen, or the whole page, as PNG."""
        shot = await self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        path.write_bytes(base64.b64decode(shot["data"]))

    async def listen(self) -> None:
        """Take in what the browser tells, until it ends."""
        async for message in self._socket:
            news = message.json()
            if "id" in news:
                self._answers.pop(news["id"]).set_result(news)
            else:
                self._note(news["method"], news["params"])

    def _note(self, event: str, told: dict) -> None:
        if event == "Runtime.exceptionThrown":
            details = told["exceptionDetails"]
            self.complaints.append(details.get("exception", {}).get("description") or details["text"])
        elif event == "Runtime.consoleAPICalled" and told["type"] in ("error", "warning", "assert"):
            self.complaints.append(" ".join(str(each.get("value", each)) for each in told["args"]))
        elif event == "Log.entryAdded" and told["entry"]["level"] in ("error", "warning"):
            self.complaints.append(told["entry"]["text"])
        elif event == "Network.requestWillBeSent":
            self.asked.append(told["request"]["url"])
        elif event == "Network.webSocketCreated":
            self.asked.append(told["url"])


@asynccontextmanager
async def chromium(*options: str) -> AsyncIterator["Browser"]:
    """A browser of a folder of its own, which ends with the context."""
    with tempfile.TemporaryDirectory(prefix="chromium-", ignore_cleanup_errors=True) as folder:
        process = subprocess.Popen(
            [CHROMIUM, *OPTIONS, *options, f"--user-data-dir={folder}", "about:blank"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            told = Path(folder, "DevToolsActivePort")
            end = time.monotonic() + START_S
            while not (told.exists() and told.read_text().count("\n")):
                assert time.monotonic() < end, "Chromium did not begin to listen"
                assert process.poll() is None, "Chromium ended at once"
                await asyncio.sleep(0.05)
            async with aiohttp.ClientSession() as session:
                yield Browser(session, int(told.read_text().split("\n")[0]), process)
        finally:
            process.terminate()
            process.wait(START_S)


class Browser:
    """A running browser; `open` gives a tab."""

    def __init__(self, session: aiohttp.ClientSession, port: int, process: subprocess.Popen) -> None:
        self._session, self._address, self._process = session, f"http://127.0.0.1:{port}", process

    def kill(self) -> None:
        """End it at once, as a crash or a full memory does; its pages say nothing more."""
        self._process.kill()

    @asynccontextmanager
    async def open(self, address: str) -> AsyncIterator[Tab]:
        """A tab at an address, with all that it says and asks for from the first byte on; it is closed at the end."""
        async with self._session.put(f"{self._address}/json/new?about:blank") as answer:
            target = await answer.json()
        async with self._session.ws_connect(target["webSocketDebuggerUrl"], max_msg_size=0) as socket:
            tab = Tab(socket)
            listening = asyncio.create_task(tab.listen())
            try:
                for domain in ("Page", "Runtime", "Log", "Network", "DOM"):
                    await tab.call(f"{domain}.enable")
                await tab.call("Page.navigate", url=address)
                yield tab
            finally:
                listening.cancel()
                # left open it draws on, and looks for its server at a port that another test's may get
                with suppress(aiohttp.ClientError):  # where the browser has ended before it
                    async with self._session.put(f"{self._address}/json/close/{target['id']}"):
                        pass
