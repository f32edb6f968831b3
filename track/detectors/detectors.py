"""The table of detectors; a new one is a module and a line here."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from regress.runtime.stages.stage import Stage
from track.detectors.mediapipe import MediapipeDetector
from track.detectors.points import PointsDetector
from track.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Detector:
    """One way to 68 points.

    Parameters
    ----------
    description
        For people.
    open
        Makes the stage, which has a ``close``; takes the model file that somebody named, if any.
    """

    description: str
    open: Callable[[Path | None], Stage]


DETECTORS: dict[str, Detector] = {
    "mediapipe": Detector(
        description="MediaPipe Face Landmarker: points, irises and head of a face in a picture",
        open=MediapipeDetector,
    ),
    "points": Detector(
        description="points from anyone's detector, as lines on standard input",
        open=lambda file: PointsDetector(),
    ),
}


def open_detector(name: str, file: Path | None = None) -> Stage:
    """Make the detector of this name.

    Raises
    ------
    InputError
        Where there is none, or its model file cannot be used.
    """
    if name not in DETECTORS:
        raise InputError(f"there is no detector {name!r}; {' and '.join(DETECTORS)} are there")
    return DETECTORS[name].open(file)
