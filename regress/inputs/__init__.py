"""Readers of what landmark detectors write; a new format is one new module and one line in ``READERS``."""

from regress.inputs.frames import Frames
from regress.inputs.readers import READERS, Reader, read_frames

__all__ = ["READERS", "Frames", "Reader", "read_frames"]
