"""Opens and reads what OpenCV reads, without its own talk on standard error: that can hold an address' password."""

import os

import cv2
import numpy as np

from facegen.formats.picture_size import MOST_PIXELS

_WAIT_MS = 3000
"""For an address to answer, and for its next picture."""


def opened(place: str | int, backend: int) -> cv2.VideoCapture | None:
    """A camera, a film or an address; None where OpenCV cannot open it, or its pictures are too large.

    Parameters
    ----------
    place
        A camera's number, a file's name, or an address.
    backend
        One of OpenCV's ``CAP_``.
    """
    _silence()
    # both are asked for once, at the first opening: AV_LOG_QUIET, and seconds until a silent camera lets Ctrl-C through
    os.environ["OPENCV_FFMPEG_LOGLEVEL"] = "-8"
    os.environ.setdefault("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "2")
    waits = [cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, _WAIT_MS, cv2.CAP_PROP_READ_TIMEOUT_MSEC, _WAIT_MS]
    try:
        capture = cv2.VideoCapture(place, backend, waits if backend == cv2.CAP_FFMPEG else [])
    except cv2.error:
        return None
    pixels = capture.get(cv2.CAP_PROP_FRAME_WIDTH) * capture.get(cv2.CAP_PROP_FRAME_HEIGHT)
    if not capture.isOpened() or pixels > MOST_PIXELS:
        capture.release()
        return None
    # telephones write films as the sensor lies, and how to turn them; OpenCV 4.11 does so for who asks
    capture.set(cv2.CAP_PROP_ORIENTATION_AUTO, 1)
    return capture


def _silence() -> None:
    """Switch OpenCV's own log off: 4.11 does so by one name, 4.14 by another."""
    set_level = cv2.setLogLevel if hasattr(cv2, "setLogLevel") else cv2.utils.logging.setLogLevel
    set_level(0)


def grabbed(capture: cv2.VideoCapture) -> np.ndarray | None:
    """The next picture; None where none comes."""
    try:
        there, pixels = capture.read()
    except cv2.error:
        return None
    return pixels if there else None
