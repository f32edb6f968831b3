"""What `track` takes: processor time of each stage, and the time from a picture to the datagram that it moves.

    python benchmarks/track_latency.py --film face.mp4 --seconds 60   # MediaPipe, landmark networks, 30 a second
    python benchmarks/track_latency.py --headset --seconds 600        # three cameras of 96 pixels, 120 a second
    python benchmarks/track_latency.py --headset --page               # the same while a tab looks and wants pictures

Cameras are virtual: pictures are in memory and come at their times, as a driver would give them; --buffers says how
many wait there for whoever reads them. Answers go by VMC, and are received by a socket of this process. The tab of
--page is another process, which reads what the page is sent. Figures are of all frames behind the first two seconds,
not of the last ones alone. A picture is lost where no frame has it: because its buffer was filled anew before anybody
read it (lost_by_driver), or because newer ones took its place. Figures of runs stand in docs/track.md and
docs/track-headset.md.

On a machine that others use as well, `chrt -f 5` before the command (Linux, as root) makes it go first: what is left of
the tail is then our own.
"""

import argparse
import json
import os
import platform
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import cv2
import numpy as np

from regress.runtime.sample import Sample
from track.detectors import open_detector
from track.page import Page
from track.profile.profile import Profile
from track.session.headset import HeadsetPipeline
from track.session.landmarks import LandmarkPipeline
from track.session.measures import Measures
from track.session.session import Session
from track.sinks.targets import open_sink, parse_target
from track.sources import Capture, Picture, Source

WARM_S = 2.0
"""Seconds of frames that are not measured."""

SAMPLES = Path(__file__).resolve().parents[1] / "docs" / "samples" / "headset"


BUFFERS = 4
"""In which a driver keeps pictures that nobody has read yet: so many OpenCV asks of Video4Linux."""

REMEMBERED = 64
"""Pictures of a camera that can still be told from one another."""


class VirtualCamera(Source):
    """Gives pictures at a rate, there and back; one whose buffer is needed before it was read is lost.

    Attributes
    ----------
    recent
        The last pictures, by their ``id``: each with its number, and how many were lost before it.
    """

    def __init__(self, title: str, pictures: list[np.ndarray], fps: float, buffers: int) -> None:
        self.title, self._pictures, self._fps, self._buffers = title, pictures, fps, buffers
        self._start_s = time.monotonic()
        self._last, self._lost = -1, 0
        self.recent: dict[int, tuple[np.ndarray, int, int]] = {}

    def read(self) -> Picture:
        """The next picture, when its time has come."""
        newest = int((time.monotonic() - self._start_s) * self._fps)
        number = max(self._last + 1, newest - self._buffers + 1)
        self._lost += number - self._last - 1
        self._last = number
        due_s = self._start_s + number / self._fps
        time.sleep(max(0.0, due_s - time.monotonic()))
        period = 2 * len(self._pictures) - 2
        place = number % period
        pixels = self._pictures[min(place, period - place)].view()
        self.recent[id(pixels)] = pixels, number, self._lost
        if len(self.recent) > REMEMBERED:
            del self.recent[next(iter(self.recent))]
        return Picture(time_s=due_s, pixels=pixels)

    def now_s(self) -> float:
        return time.monotonic()

    def close(self) -> None:
        """Nothing is held."""


class Receiver(threading.Thread):
    """Counts datagrams, each set of a frame by its last one."""

    def __init__(self) -> None:
        super().__init__(daemon=True)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(0.5)
        self.port, self.count, self.over = self.socket.getsockname()[1], 0, False

    def run(self) -> None:
        while not self.over:
            try:
                self.socket.recv(4096)
            except TimeoutError:
                continue
            self.count += 1


class Counted:
    """A capture that counts from a moment on which pictures of its cameras came in frames, and which did not.

    Parameters
    ----------
    capture, cameras
        The cameras are the capture's, by name.
    begin
        Called at the first moment that counts, `WARM_S` after the first one: networks warm up before.
    """

    def __init__(
        self, capture: Capture, cameras: dict[str, VirtualCamera], begin: Callable[[], None]
    ) -> None:
        self._capture, self.now_s = capture, capture.now_s
        self._cameras, self._begin = cameras, begin
        self._begins_s = time.monotonic() + WARM_S
        self._last: dict[str, tuple[int, int]] = {}
        self._counts = False
        self.taken = self.lost = self.lost_by_driver = 0

    def read(self, within_s: float | None = None) -> Sample | None:
        """The next moment."""
        sample = self._capture.read(within_s)
        for name, picture in sample.pictures.items():
            _, number, lost_before = self._cameras[name].recent[id(picture)]
            last, last_lost = self._last.get(name, (number - 1, lost_before))
            self._last[name] = number, lost_before
            if self._counts and number != last:  # a late camera's last picture comes again
                self.taken += 1
                self.lost += number - last - 1
                self.lost_by_driver += lost_before - last_lost
        if not self._counts and time.monotonic() > self._begins_s:
            self._counts = True
            self._begin()
        return sample


TAB = """
import asyncio, aiohttp, json, sys

async def look(link):
    async with aiohttp.ClientSession() as web, web.ws_connect(link + "stream", origin=link[:-1]) as stream:
        await stream.send_json({"verb": "picture", "value": True})
        async for message in stream:
            if message.type is aiohttp.WSMsgType.TEXT and (said := json.loads(message.data))["type"] == "frame":
                await stream.send_json({"verb": "seen", "value": said["number"]})

asyncio.run(look(sys.argv[1]))
"""


@contextmanager
def page_of(session: Session, cameras: tuple[str, ...]) -> Iterator[Page]:
    """The session's page, with a tab that looks."""
    with Page(session.ask, cameras=cameras) as page:
        tab = subprocess.Popen([sys.executable, "-c", TAB, page.url])
        try:
            until_s = time.monotonic() + 20
            while not page.wants_pictures and time.monotonic() < until_s:
                time.sleep(0.1)
            if not page.wants_pictures:
                raise SystemExit("the tab does not look")
            yield page
        finally:
            tab.terminate()
            tab.wait()


def stolen_s() -> float:
    """Seconds that the host kept this virtual machine's cores for others, since it started; NaN but on Linux."""
    try:
        return int(Path("/proc/stat").read_text().split()[8]) / os.sysconf("SC_CLK_TCK")
    except OSError:
        return float("nan")


def film_pictures(path: Path, most: int = 300) -> list[np.ndarray]:
    """Pictures of a film, in memory."""
    film, pictures = cv2.VideoCapture(str(path)), []
    while len(pictures) < most:
        there, picture = film.read()
        if not there:
            break
        pictures.append(picture)
    film.release()
    return pictures


def headset_pictures(camera: str) -> list[np.ndarray]:
    """Of the sample, with a sensor's noise, so that no camera is frozen."""
    rng = np.random.default_rng(0)
    plain = [cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) for path in sorted((SAMPLES / camera).iterdir())]
    return [np.clip(each + rng.normal(0, 1, each.shape), 0, 255).astype(np.uint8) for each in plain]


def measure(arguments: argparse.Namespace) -> dict[str, object]:
    """Run a session, and what it took."""
    receiver = Receiver()
    receiver.start()
    sink = open_sink(parse_target(f"vmc:127.0.0.1:{receiver.port}"), print)
    if arguments.headset:
        fps = arguments.fps or 120.0
        pipeline = HeadsetPipeline("headset-tracking3", filter_name="groups")
        pictures = {name: headset_pictures(name) for name in pipeline.cameras}
    else:
        fps = arguments.fps or 30.0
        detector = open_detector("mediapipe")
        pipeline = LandmarkPipeline(
            "landmarks-default", detector=detector, detector_name="mediapipe", filter_name="groups"
        )
        pictures = {"camera": film_pictures(arguments.film)}
    cameras: dict[str, VirtualCamera] = {}

    def opener(name: str):
        def open_camera() -> VirtualCamera:
            cameras[name] = VirtualCamera(name, pictures[name], fps, arguments.buffers)
            return cameras[name]

        return open_camera

    session = Session(
        pipeline=pipeline, sinks=[sink], profile=Profile(person="nobody", camera="virtual"), say=print
    )
    before: dict[str, float] = {}

    def begin() -> None:
        session.measures = Measures(remembered=int(arguments.seconds * fps) + 1000)
        before.update(cpu_s=time.process_time(), wall_s=time.monotonic(), stolen_s=stolen_s())

    with ExitStack() as open_now:
        capture = open_now.enter_context(Capture({name: opener(name) for name in pictures}))
        screen = open_now.enter_context(page_of(session, tuple(pictures))) if arguments.page else None
        counted = Counted(capture, cameras, begin)
        summary = session.run(counted, screen, seconds=WARM_S + arguments.seconds)
        cpu_s, wall_s = time.process_time() - before["cpu_s"], time.monotonic() - before["wall_s"]
    session.close()
    receiver.over = True
    receiver.join()
    return {
        "pictures": counted.taken + counted.lost,
        "pictures_lost": counted.lost,
        "lost_by_driver": counted.lost_by_driver,
        "frames": summary.frames,
        "datagrams": receiver.count,
        "seconds": wall_s,
        "process_cpu_ms_per_frame": 1e3 * cpu_s / max(summary.frames, 1),
        "without_detector_cpu_ms_p50": sum(
            figures["p50"] for name, figures in summary.cpu_ms.items() if name != "detector"
        ),
        "picture_to_datagram_ms": summary.latency_ms,
        "cpu_ms": summary.cpu_ms,
        "stolen_by_the_host_s": stolen_s() - before["stolen_s"],
        "machine": f"{platform.machine()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.0f}",
    }


def main() -> None:
    """Measure, and print a table or JSON."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--film", type=Path, help="a film with a face")
    kind.add_argument("--headset", action="store_true", help="the sample of docs/samples/headset")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--fps", type=float, help="pictures a second; 30 of a film, 120 of a headset")
    parser.add_argument(
        "--buffers", type=int, default=BUFFERS, help="in which a driver keeps what nobody has read yet"
    )
    parser.add_argument("--page", action="store_true", help="with a tab that looks and wants pictures")
    parser.add_argument("--json", action="store_true")
    found = measure(arguments := parser.parse_args())
    if arguments.json:
        print(json.dumps(found))
        return
    for name, figures in found.pop("cpu_ms").items():
        print(f"{name:<14} CPU ms  p50 {figures['p50']:6.2f}  p95 {figures['p95']:6.2f}")
    for name, value in found.items():
        print(f"{name:<30} {value if not isinstance(value, float) else round(value, 2)}")


if __name__ == "__main__":
    main()
