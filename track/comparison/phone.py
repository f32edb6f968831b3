"""Listens to a phone that sends Live Link Face, and puts its frames on this machine's clock.

`track.sinks.live_link` has the layout and its sources.
"""

import socket
import struct
import threading
import time
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES
from track.errors import InputError

PORT = 11111

MOST_DATAGRAM_BYTES = 2048
"""Of one frame; the app sends 313."""

MOST_FRAMES = 10_000_000
"""Kept of a phone: 46 hours at 60 a second, 4 GB; a comparison takes minutes."""

MOST_TEXT_BYTES = 256
"""Of a device's or a subject's name."""

_VERSION, _VALUES = 6, 61

_QUICKEST = 0.1
"""Quantile of the times underway: the quickest tenth of datagrams waited nowhere."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PhoneFrame:
    """One frame as the phone sent it.

    Parameters
    ----------
    timecode_s
        By the phone's own clock.
    weights : (52,) float64 or None
        None where it saw no face.
    """

    timecode_s: float
    weights: np.ndarray | None


def read_frame(datagram: bytes) -> PhoneFrame | None:
    """A datagram's frame; None where it is something else."""
    try:
        (version,), place = struct.unpack_from("!B", datagram), 1
        for _ in range(2):
            (length,) = struct.unpack_from("!i", datagram, place)
            if not 0 <= length <= MOST_TEXT_BYTES:
                return None
            place += 4 + length
        frame, part, rate, denominator = struct.unpack_from("!ifii", datagram, place)
        place += 16
        if version != _VERSION or rate <= 0 or denominator <= 0 or not np.isfinite(part):
            return None
        timecode_s = (frame + part) * denominator / rate
        if place == len(datagram):
            return PhoneFrame(timecode_s=timecode_s, weights=None)
        (count,) = struct.unpack_from("!B", datagram, place)
        if count != _VALUES or len(datagram) != place + 1 + 4 * count:
            return None
        values = np.frombuffer(datagram, dtype=">f4", offset=place + 1)
    except struct.error:
        return None
    if not np.isfinite(values).all():  # before they are made wider: a signalling NaN warns there
        return None
    weights = values[: len(BLENDSHAPES)].astype(np.float64)
    return PhoneFrame(timecode_s=timecode_s, weights=np.clip(weights, 0, 1))


class Phone:
    """Receives in a thread of its own, until it is closed.

    Parameters
    ----------
    port
        To listen on, of all addresses of this machine: the phone is another one. 0 takes a free one.

    Raises
    ------
    InputError
        Where the port is taken.
    """

    def __init__(self, port: int = PORT) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.bind(("", port))
        except OSError as error:
            self._socket.close()
            raise InputError(
                f"--truth livelink:{port}: nothing can listen there ({error.strerror}); close what does, or take "
                f"another port in the phone's app as well"
            ) from None
        self.port = self._socket.getsockname()[1]
        self._socket.settimeout(0.1)
        self._came: list[tuple[float, PhoneFrame]] = []
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="phone", daemon=True)
        self._thread.start()

    @property
    def count(self) -> int:
        """Frames with a face that came."""
        return len(self._came)

    def close(self) -> None:
        """Stop listening."""
        self._closing.set()
        self._thread.join()
        self._socket.close()

    def frames(self) -> tuple[np.ndarray, np.ndarray]:
        """Times (n,) by ``time.perf_counter`` and weights (n, 52) of what came with a face, in the order of time."""
        came = list(self._came)
        if not came:
            return np.zeros(0), np.zeros((0, len(BLENDSHAPES)))
        arrival = np.array([at_s for at_s, _ in came])
        timecode = np.array([frame.timecode_s for _, frame in came])
        weights = np.array([frame.weights for _, frame in came])
        times_s = on_this_clock(arrival, timecode)
        order = np.argsort(times_s, kind="stable")
        return times_s[order], weights[order]

    def _run(self) -> None:
        while not self._closing.is_set():
            try:
                datagram = self._socket.recv(MOST_DATAGRAM_BYTES)
            except TimeoutError:
                continue
            except OSError:  # a network that went away; it may come back
                self._closing.wait(0.1)
                continue
            frame = read_frame(datagram)
            if frame is not None and frame.weights is not None and len(self._came) < MOST_FRAMES:
                self._came.append((time.perf_counter(), frame))


def on_this_clock(arrival_s: np.ndarray, timecode_s: np.ndarray) -> np.ndarray:
    """Times (n,) of frames: the phone's own, which do not jitter, shifted by what the quickest ones took.

    A phone whose times do not rise (its timecode begins anew at midnight, or stands still) is taken by arrival.
    """
    if len(timecode_s) < 2 or not (np.diff(timecode_s) > 0).all():
        return arrival_s
    if abs(np.ptp(timecode_s) - np.ptp(arrival_s)) > 0.02 * np.ptp(arrival_s) + 0.5:
        return arrival_s
    return timecode_s + np.quantile(arrival_s - timecode_s, _QUICKEST)
