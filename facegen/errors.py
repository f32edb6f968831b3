"""Errors that a user of facegen can meet, each with the exit code of the worker contract.

::

    FacegenError
    ├── InputError          2   a spec, a rig, a headset or a file that cannot be used; nothing was written
    │   ├── FormatError     2   a file whose content is not what its format says
    │   └── MissingAsset    2   a rig or headset that has not been built or does not exist
    ├── InvalidData         1   data on disk that does not agree with itself
    ├── WorkersFailed       1   worker processes that cannot start, or fail at nearly everything
    ├── OutputError        74   no space, or a place that cannot be written
    └── Drained            75   stopped on request; work remains

A message says what was found, where, what is allowed and what to do, in one sentence. Libraries raise; only ``cli``
prints.
"""


class FacegenError(Exception):
    """Base of all errors raised on purpose."""

    exit_code = 1


class InputError(FacegenError):
    """A spec, a rig, a headset or a file that cannot be used; nothing was written."""

    exit_code = 2


class FormatError(InputError):
    """A file whose content is not what its format says."""


class MissingAsset(InputError):
    """A rig or a headset that has not been built or does not exist."""


class InvalidData(FacegenError):
    """Data on disk that does not agree with itself."""

    exit_code = 1


class WorkersFailed(FacegenError):
    """Worker processes that cannot start, or fail at nearly everything: not the fault of one sample."""

    exit_code = 1


class OutputError(FacegenError):
    """No space left, or a place that cannot be written."""

    exit_code = 74


class Drained(FacegenError):
    """Stopped on request; work remains."""

    exit_code = 75
