"""Opens and reads what OpenCV reads, without its own talk on standard error: that can hold an address' password."""

import os

import cv2
import numpy as np

_WAIT_MS = 3000
"""For an address to answer, and for its next picture."""


def opened(place: str | int, backend: int, *, options: str | None = None) -> cv2.VideoCapture | None:
    """A camera, a film or an address; None where OpenCV cannot open it.

    Parameters
    ----------
    place
        A camera's number, a file's name, or an address.
    backend
        One of OpenCV's ``CAP_``.
    options
        For FFmpeg, ``"name;value|name;value"``.
    """
    cv2.setLogLevel(0)
    os.environ["OPENCV_FFMPEG_LOGLEVEL"] = "-8"  # AV_LOG_QUIET
    if options is None:
        os.environ.pop("OPENCV_FFMPEG_CAPTURE_OPTIONS", None)
    else:
        os.environ["OPENCV_FFMPEG_CAPTURE_OPTIONS"] = options
    waits = [cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, _WAIT_MS, cv2.CAP_PROP_READ_TIMEOUT_MSEC, _WAIT_MS]
    try:
        capture = cv2.VideoCapture(place, backend, waits if backend == cv2.CAP_FFMPEG else [])
    except cv2.error:
        return None
    if not capture.isOpened():
        capture.release()
        return None
    return capture


def grabbed(capture: cv2.VideoCapture) -> np.ndarray | None:
    """The next picture; None where none comes."""
    try:
        there, pixels = capture.read()
    except cv2.error:
        return None
    return pixels if there else None
