"""Pictures from an address: MJPEG over HTTP, as self-built trackers and ESP32 boards send it, and RTSP."""

import re
import time
from urllib.parse import urlsplit

import cv2

from track.errors import CameraError
from track.sources.opencv import grabbed, opened
from track.sources.source import Picture, Source

SCHEMES = ("http", "https", "rtsp", "rtsps")


def is_address(text: str) -> bool:
    """Whether a text names a place on the network, of whatever kind."""
    return re.match(r"[A-Za-z][A-Za-z0-9+.-]*://", text) is not None


def without_secrets(address: str) -> str:
    """An address as it may be shown: without user, password and what stands behind a question mark.

    Cameras take passwords there, too (``?user=admin&password=...``), and people write signs into passwords that should
    be escaped: where it cannot be told where one ends, nothing is shown.
    """
    scheme, _, rest = address.partition("://")
    place, *query = re.split(r"[?#]", rest, maxsplit=1)
    if query and "@" in query[0]:
        return f"{scheme}://…"
    return f"{scheme}://{place.rpartition('@')[2]}"


class AddressSource(Source):
    """The pictures that an address sends, as they come; their times are when they came, by the machine's steady clock.

    OpenCV's FFmpeg reads them: whatever a server tells of boundaries and lengths, it finds the pictures (the tests have
    nine manners).

    Raises
    ------
    CameraError
        Where it is no address of this kind, or nothing that can be read comes within some seconds.
    """

    def __init__(self, address: str) -> None:
        self.title = without_secrets(address)
        if self.title.partition("://")[0].lower() not in SCHEMES or not _has_host(address):
            raise CameraError(f"{self.title} is no camera's address; these begin with {', '.join(SCHEMES)}")
        self._capture = opened(address, cv2.CAP_FFMPEG)
        if self._capture is None:
            raise CameraError(
                f"{self.title} cannot be reached, wants another password, or sends no pictures; "
                "open it in a browser to see which"
            )

    def read(self) -> Picture | None:
        """The next picture; None where the server has gone, or sends nothing for some seconds."""
        pixels = grabbed(self._capture)
        return None if pixels is None else Picture(time_s=time.perf_counter(), pixels=pixels)

    def close(self) -> None:
        """End the connection."""
        self._capture.release()


def _has_host(address: str) -> bool:
    try:
        parts = urlsplit(address)
        return bool(parts.hostname) and (parts.port is None or parts.port > 0)
    except ValueError:  # a port that is no number, or half an IPv6 address
        return False
