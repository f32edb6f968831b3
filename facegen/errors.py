"""Defines the errors that a user of facegen or regress can meet, each with the exit code of the worker contract.

::

    FacegenError
    ├── InputError          2   a spec, a rig, a headset or a file that cannot be used; nothing was written
    │   ├── FormatError     2   a file whose content is not what its format says
    │   └── MissingAsset    2   a rig or headset that has not been built or does not exist
    ├── InvalidData         1   data on disk that does not agree with itself
    ├── Unanswered          1   another program that gave no answer in time; it may have done what it was asked
    ├── WorkersFailed       1   worker processes that cannot start, or fail at nearly everything
    ├── OutputError        74   no space, or a place that cannot be written
    └── Drained            75   stopped on request; work remains

What nobody foresaw ends a program with 70 (`facegen.program`). A message says what was found, where, what is allowed
and what to do, in one sentence. Libraries raise; only ``cli`` prints.
"""

from enum import IntEnum


class ExitCode(IntEnum):
    """Exit codes of both programs."""

    OK = 0
    INVALID = 1
    BAD_INPUT = 2
    INTERNAL = 70
    NOT_WRITABLE = 74
    DRAINED = 75


class FacegenError(Exception):
    """Base of all errors raised on purpose."""

    exit_code = ExitCode.INVALID


class InputError(FacegenError):
    """A spec, a rig, a headset or a file that cannot be used; nothing was written."""

    exit_code = ExitCode.BAD_INPUT


class FormatError(InputError):
    """A file whose content is not what its format says."""


class MissingAsset(InputError):
    """A rig or a headset that has not been built or does not exist."""


class InvalidData(FacegenError):
    """Data on disk that does not agree with itself."""


class Unanswered(FacegenError):
    """Another program that gave no answer in time; it may have done what it was asked."""


class WorkersFailed(FacegenError):
    """Worker processes that cannot start, or fail at nearly everything: not the fault of one sample."""


class OutputError(FacegenError):
    """No space left, or a place that cannot be written."""

    exit_code = ExitCode.NOT_WRITABLE


class Drained(FacegenError):
    """Stopped on request; work remains."""

    exit_code = ExitCode.DRAINED
