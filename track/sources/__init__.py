"""Where pictures come from: webcams, films, folders, addresses; each gives one camera's pictures with their times."""

from track.sources.camera import Opener
from track.sources.capture import Capture
from track.sources.faults import CameraFault
from track.sources.source import Picture, Source
from track.sources.sources import SOURCES, Pace, SourceKind, open_capture, open_source

__all__ = [
    "SOURCES",
    "CameraFault",
    "Capture",
    "Opener",
    "Pace",
    "Picture",
    "Source",
    "SourceKind",
    "open_capture",
    "open_source",
]
