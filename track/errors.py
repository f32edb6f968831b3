"""Errors that a user of track can meet: those of the ground, `facegen.errors`, and what is track's own.

::

    InputError            2   a camera, a profile, a model or an address that cannot be used
    └── CameraError       2   a camera that is not there, is busy, or gives no picture
    OutputError          74   a recording that cannot be written

A message says what was found, where and what is allowed, in one sentence. Libraries raise; only ``cli`` prints.
"""

from facegen.errors import InputError, OutputError

__all__ = ["CameraError", "InputError", "OutputError"]


class CameraError(InputError):
    """A camera that is not there, is busy, or gives no picture."""
