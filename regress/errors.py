"""Errors that a user of regress can meet, each with the exit code of the worker contract.

::

    RegressError
    ├── InputError          2   a dataset, a model or a file that cannot be used; nothing was written
    │   └── ModelError      2   a model folder that is missing, incomplete or does not agree with itself
    ├── OutputError        74   no space, or a place that cannot be written
    └── Interrupted        75   stopped on request; nothing half-written stays behind

A message says what was found, where and what is allowed, in one sentence. Libraries raise; only ``cli``
prints. Readers of ``facegen.formats`` raise :class:`facegen.formats.FormatError`, whose exit code is 2 too.
"""

from facegen.conventions import ExitCode


class RegressError(Exception):
    """Base of all errors raised on purpose."""

    exit_code = ExitCode.INVALID


class InputError(RegressError):
    """A dataset, a model or a file that cannot be used; nothing was written."""

    exit_code = ExitCode.BAD_INPUT


class ModelError(InputError):
    """A model folder that is missing, incomplete or does not agree with itself."""


class OutputError(RegressError):
    """No space left, or a place that cannot be written."""

    exit_code = ExitCode.NOT_WRITABLE


class Interrupted(RegressError):
    """Stopped on request; nothing half-written stays behind."""

    exit_code = ExitCode.DRAINED
