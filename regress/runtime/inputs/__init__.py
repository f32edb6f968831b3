"""Readers of what landmark detectors write; a new format is one new module and one line in ``READERS``."""

from regress.runtime.inputs.faults import (
    Fault,
    TimeOrder,
    emptied,
    face_faults,
    joined_runs,
    row_faults,
    told,
)
from regress.runtime.inputs.frames import Frames
from regress.runtime.inputs.readers import READERS, Reader, read_frames

__all__ = [
    "READERS",
    "Fault",
    "Frames",
    "Reader",
    "TimeOrder",
    "emptied",
    "face_faults",
    "joined_runs",
    "read_frames",
    "row_faults",
    "told",
]
