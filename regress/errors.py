"""Errors that a user of regress can meet: those of the ground, `facegen.errors`, and what is regress's own.

::

    InputError          2   a dataset, a model or a file that cannot be used; nothing was written
    └── ModelError      2   a model folder that is missing, incomplete or does not agree with itself
    OutputError        74   no space, or a place that cannot be written
    Drained            75   stopped on request
    └── Interrupted    75   nothing half-written stays behind

A message says what was found, where and what is allowed, in one sentence. Libraries raise; only ``cli`` prints.
"""

from facegen.errors import Drained, InputError, OutputError

__all__ = ["InputError", "Interrupted", "ModelError", "OutputError"]


class ModelError(InputError):
    """A model folder that is missing, incomplete or does not agree with itself."""


class Interrupted(Drained):
    """Stopped on request; nothing half-written stays behind."""
