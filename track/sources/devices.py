"""Looks through each webcam of this machine once."""

from dataclasses import asdict, dataclass
from pathlib import Path

import cv2

from facegen.files import output_errors, write_whole
from track.errors import CameraError
from track.sources.node_faults import refusal
from track.sources.picture_rate import rate_of
from track.sources.webcams import FOLDER, Webcam, WebcamSource, list_webcams

_SETTLING = 5
"""Pictures until a camera's exposure has found the room's light; the first ones are often black."""

_TIMED = 12
"""Pictures behind them by which the rate is measured: 0.4 s of most cameras."""


NO_PICTURE = (
    "gives no picture: another program may be using it, or it is no camera (some have a second, mute entry)"
)


@dataclass(frozen=True, kw_only=True)
class Seen:
    """A webcam, and what it showed.

    Parameters
    ----------
    number, name
        As in `Webcam`.
    width, height
        Of its pictures; None where it gives none.
    fps
        Pictures a second that came, to a tenth; None where too few did.
    picture
        File of the one that was kept.
    fault
        Why it gives none.
    """

    number: int
    name: str
    width: int | None = None
    height: int | None = None
    fps: float | None = None
    picture: Path | None = None
    fault: str | None = None

    def record(self) -> dict[str, object]:
        """For JSON."""
        return {**asdict(self), "picture": None if self.picture is None else str(self.picture)}


def look_at_webcams(pictures: Path | None = None, *, folder: Path | None = None) -> list[Seen]:
    """All webcams, each opened for a moment.

    Parameters
    ----------
    pictures
        Folder for a JPEG of each, ``camera-N.jpg``; nothing is kept without.

    Raises
    ------
    OutputError
        Where it cannot be written there.
    """
    folder = FOLDER if folder is None else folder
    if pictures is not None:
        with output_errors(pictures):
            pictures.mkdir(parents=True, exist_ok=True)
    return [_look(webcam, pictures, folder) for webcam in list_webcams(folder)]


def _look(webcam: Webcam, pictures: Path | None, folder: Path) -> Seen:
    try:
        camera = WebcamSource(str(webcam.number), folder=folder)
    except CameraError:
        reason = refusal(webcam.number)
        fault = NO_PICTURE if reason is None else f"gives no picture: {reason}"
        return Seen(number=webcam.number, name=webcam.name, fault=fault)
    try:
        pixels, times_s = None, []
        for number in range(_SETTLING + _TIMED):
            picture = camera.read()
            if picture is None:
                break
            pixels = picture.pixels
            if number >= _SETTLING:
                times_s.append(picture.time_s)
    finally:
        camera.close()
    file = None
    if pictures is not None:
        file = write_whole(
            pictures / f"camera-{webcam.number}.jpg", cv2.imencode(".jpg", pixels)[1].tobytes()
        )
    height, width = pixels.shape[:2]
    fps = rate_of(times_s)
    return Seen(
        number=webcam.number,
        name=webcam.name,
        width=width,
        height=height,
        fps=None if fps is None else round(fps, 1),
        picture=file,
    )
