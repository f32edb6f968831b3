"""Why a webcam was not opened, for a person: what was wanted, what there is, and what to do."""

import sys
from collections.abc import Callable
from pathlib import Path

from facegen.formats.film import FILMS
from track.sources.mac_permission import SETTINGS
from track.sources.node_faults import refusal
from track.sources.video_nodes import Webcam, device_number, number_of


def why_not(wanted: str, list_webcams: Callable[[], list[Webcam]]) -> str:
    """A sentence for a camera that cannot be opened; the system's cameras are listed only where that says more."""
    if wanted.isdecimal() and not sys.platform.startswith("linux"):
        allowed = f", and macOS must allow the camera in {SETTINGS}" if sys.platform == "darwin" else ""
        return (
            f"camera {wanted} gives no picture, or there is none of this number; `track devices` lists those that do"
            f"{allowed}"
        )
    webcams = list_webcams()
    if (asked := number_of(wanted)) is not None and (reason := refusal(asked)):
        return f"camera {wanted} gives no picture: {reason}"
    number = wanted if (device := device_number(wanted)) is None else str(device)
    known = any(number == str(webcam.number) or wanted.lower() in webcam.name.lower() for webcam in webcams)
    if not known and device is None and (Path(wanted).suffix.lower() in FILMS or len(Path(wanted).parts) > 1):
        return f"there is no file {wanted}; give a film or a folder of pictures that is there, or a webcam's number"
    if not webcams:
        return f"there is no camera {wanted} here, nor a file of this name; plug one in, or say --camera FILM"
    listed = ", ".join(f"{webcam.number} ({webcam.name})" for webcam in webcams)
    if known:
        fitting = [each.number for each in webcams if wanted.lower() in each.name.lower()]
        reason = next(filter(None, map(refusal, fitting)), "another program may be using it")
        return f"camera {wanted} gives no picture: {reason}; cameras here: {listed}"
    return f"there is no camera {wanted}, nor a file of this name; cameras here: {listed}"
