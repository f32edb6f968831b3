"""Readers of what landmark detectors write; a new format is one new module and one line in ``READERS``."""

from regress.runtime.inputs.faults import (
    Fault,
    TimeOrder,
    face_faults,
    fault_sentences,
)
from regress.runtime.inputs.frames import Frames
from regress.runtime.inputs.lines import read_lines, text_lines
from regress.runtime.inputs.readers import READERS, Reader, read_frames

__all__ = [
    "READERS",
    "Fault",
    "Frames",
    "Reader",
    "TimeOrder",
    "face_faults",
    "fault_sentences",
    "read_frames",
    "read_lines",
    "text_lines",
]
