"""Readers of what landmark detectors write; a new format is one new module and one line in ``READERS``."""

from regress.inputs.faults import Fault, TimeOrder, emptied, face_faults, joined_runs, row_faults, told
from regress.inputs.frames import Frames
from regress.inputs.readers import READERS, Reader, read_frames

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
