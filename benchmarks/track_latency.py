"""What `track` takes: processor time of each stage, and the time from a picture to the datagram that it moves.

    python benchmarks/track_latency.py --film face.mp4 --seconds 60   # MediaPipe, landmark networks, 30 a second
    python benchmarks/track_latency.py --headset --seconds 600        # three cameras of 96 pixels, 120 a second

Cameras are virtual: pictures are in memory and come at their times, as a driver would give them. Answers go by VMC, and
are received by a socket of this process. Figures of one run stand in docs/track.md.
"""

import argparse
import json
import os
import platform
import socket
import threading
import time
from pathlib import Path

import cv2
import numpy as np

from track.detectors import open_detector
from track.profile.profile import Profile
from track.session.headset import HeadsetPipeline
from track.session.landmarks import LandmarkPipeline
from track.session.measures import Measures
from track.session.session import Session
from track.sinks.targets import open_sink, parse_target
from track.sources import Capture, Picture, Source

SAMPLES = Path(__file__).resolve().parents[1] / "docs" / "samples" / "headset"


class VirtualCamera(Source):
    """Gives pictures at a rate, there and back; a picture that is not read in time is lost, as a driver's is."""

    def __init__(self, title: str, pictures: list[np.ndarray], fps: float) -> None:
        self.title, self._pictures, self._fps = title, pictures, fps
        self._start_s = time.monotonic()
        self.given = self.lost = 0
        self._last = -1

    def read(self) -> Picture:
        """The next picture, when its time has come."""
        number = max(self._last + 1, int((time.monotonic() - self._start_s) * self._fps))
        self.lost += number - self._last - 1
        self._last = number
        due_s = self._start_s + number / self._fps
        time.sleep(max(0.0, due_s - time.monotonic()))
        self.given += 1
        period = 2 * len(self._pictures) - 2
        place = number % period
        return Picture(time_s=due_s, pixels=self._pictures[min(place, period - place)])

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
        pipeline = HeadsetPipeline("headset-tracking3", fps=fps, filter_name="groups")
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
            cameras[name] = VirtualCamera(name, pictures[name], fps)
            return cameras[name]

        return open_camera

    session = Session(
        pipeline=pipeline, sinks=[sink], profile=Profile(person="nobody", camera="virtual"), say=print
    )
    # networks warm up on the first pictures, and are measured on the others
    with Capture({name: opener(name) for name in pictures}) as capture:
        session.run(capture, seconds=2.0)
        session.measures = Measures()
        lost_before = sum(each.lost for each in cameras.values())
        given_before = cameras[next(iter(cameras))].given
        cpu, wall = time.process_time(), time.monotonic()
        summary = session.run(capture, seconds=arguments.seconds)
        cpu, wall = time.process_time() - cpu, time.monotonic() - wall
        lost = sum(each.lost for each in cameras.values()) - lost_before
        given = cameras[next(iter(cameras))].given - given_before
    session.close()
    receiver.over = True
    receiver.join()
    return {
        "pictures": given,
        "frames": summary.frames,
        "late_for_the_driver": lost,
        "datagrams": receiver.count,
        "seconds": wall,
        "process_cpu_ms_per_frame": 1e3 * cpu / max(summary.frames, 1),
        "without_detector_cpu_ms_p50": sum(
            figures["p50"] for name, figures in summary.cpu_ms.items() if name != "detector"
        ),
        "picture_to_datagram_ms": summary.latency_ms,
        "cpu_ms": summary.cpu_ms,
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
