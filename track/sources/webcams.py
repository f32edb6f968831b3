"""Which cameras this machine has, as Linux names them; elsewhere the numbers that open."""

from dataclasses import dataclass
from pathlib import Path

_CLASS = Path("/sys/class/video4linux")


@dataclass(frozen=True, kw_only=True)
class Webcam:
    """A camera.

    Parameters
    ----------
    number
        As OpenCV opens it.
    name
        As its driver calls it.
    """

    number: int
    name: str


def list_webcams() -> list[Webcam]:
    """The cameras that the system tells of, by their numbers."""
    folders = sorted(_CLASS.glob("video*"), key=lambda folder: int(folder.name[5:]))
    return [Webcam(number=int(each.name[5:]), name=(each / "name").read_text().strip()) for each in folders]
