"""Pictures from an address: MJPEG over HTTP, as self-built trackers and ESP32 boards send it, and RTSP."""

import hashlib
import ipaddress
import os
import re
import time
from urllib.parse import urlsplit

import cv2

from facegen.redaction import without_secrets
from track.errors import CameraError
from track.sources.opencv import grabbed, opened
from track.sources.source import Picture, Source

SCHEMES = ("http", "https", "rtsp", "rtsps")


def is_address(text: str) -> bool:
    """Whether a text names a place on the network, of whatever kind."""
    return re.match(r"[A-Za-z][A-Za-z0-9+.-]*://", text) is not None


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
        _go_past_proxies(urlsplit(address).hostname)
        _, sign, query = address.partition("?")
        if sign:  # it may hold a password, and cameras of one host may differ by nothing else
            self.mark = hashlib.sha256(query.encode(errors="backslashreplace")).hexdigest()[:6]
        self._capture = opened(address, cv2.CAP_FFMPEG)
        if self._capture is None:
            raise CameraError(
                f"{self.title} cannot be reached, wants another password, or sends no pictures; close other programs "
                "that show it, as many cameras send to one alone"
            )

    def read(self) -> Picture | None:
        """The next picture; None where the server has gone, or sends nothing for some seconds."""
        pixels = grabbed(self._capture)
        return None if pixels is None else Picture(time_s=time.perf_counter(), pixels=pixels)

    def close(self) -> None:
        """End the connection."""
        self._capture.release()


def is_local(host: str) -> bool:
    """Whether a host is of one's own network, which no proxy outside of it can reach."""
    try:
        place = ipaddress.ip_address(host)
    except ValueError:
        return "." not in host or host.endswith((".local", ".lan", ".home.arpa", ".internal"))
    return place.is_private or place.is_loopback or place.is_link_local


def _go_past_proxies(host: str) -> None:
    """FFmpeg sends all addresses through the proxy of ``http_proxy`` but those of ``no_proxy``."""
    spared = os.environ.get("no_proxy") or os.environ.get("NO_PROXY", "")
    if is_local(host) and os.environ.get("http_proxy") and host not in spared.split(","):
        os.environ["no_proxy"] = ",".join(filter(None, (spared, host)))


def _has_host(address: str) -> bool:
    try:
        parts = urlsplit(address)
        return bool(parts.hostname) and (parts.port is None or parts.port > 0)
    except ValueError:  # a port that is no number, or half an IPv6 address
        return False
