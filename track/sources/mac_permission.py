"""What macOS needs of a person: permission at the first start, and another start after a camera was unplugged."""

import sys
import time
from collections.abc import Callable

from track.sources.camera_memory import CameraMemory

PERMISSION_S = 30.0
"""For a person to answer macOS; until then every try to open a camera fails."""

_PAUSE_S = 1.0

SETTINGS = "System Settings > Privacy & Security > Camera"


def opened_with_permission(attempt: Callable[[], bool], title: str, memory: CameraMemory) -> bool:
    """Whether an attempt to open a camera succeeds; on macOS it is made again and again until a person answered.

    Parameters
    ----------
    attempt
        Opens it, and says whether it gave a picture.
    title
        What a person calls it.
    memory
        Of the camera; nobody is waited for where nothing can be said.
    """
    came = attempt()
    if came or sys.platform != "darwin":
        return came
    if memory.opened:
        # a session of AVFoundation finds no device that was plugged in later (github.com/opencv/opencv/issues/27294)
        memory.tell(
            "gone",
            f"{title} went away, and macOS gives it to new programs alone; end track and start it again",
        )
        return False
    until_s = time.perf_counter() + (0.0 if memory.say is None else PERMISSION_S)
    while not came and time.perf_counter() < until_s:
        memory.tell(
            "permission",
            f"{title} gives no picture yet; allow this terminal the camera in {SETTINGS}, "
            f"track tries for {PERMISSION_S:.0f} s",
        )
        time.sleep(_PAUSE_S)
        came = attempt()
    return came
