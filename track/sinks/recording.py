"""Keeps a file that is being recorded under a private name beside its place, until it is whole."""

import contextlib
from pathlib import Path

from facegen.files import whole_file
from regress.runtime.sample import Sample


class Recording:
    """A file in the making; it appears by `keep`, or not at all.

    Parameters
    ----------
    path
        The file; its folder must exist.

    Attributes
    ----------
    part
        Where to write meanwhile: in a folder of this recording alone, where other files may lie too.

    Raises
    ------
    InputError, OutputError
        Where the file cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._whole = contextlib.ExitStack()
        self.part: Path = self._whole.enter_context(whole_file(path))

    def keep(self) -> None:
        """Give what was written its name."""
        self._whole.close()

    def drop(self) -> None:
        """Remove what was written."""
        # as if the block of a `with` had raised: whole_file then names nothing
        self._whole.__exit__(_Dropped, _Dropped(), None)


class _Dropped(Exception):
    pass


class Clock:
    """Times of a recording: seconds from its first frame that has one."""

    def __init__(self) -> None:
        self._start_s: float | None = None

    def of(self, sample: Sample) -> float:
        """A sample's time; NaN where it has none."""
        time_s = float("nan") if sample.time_s is None else float(sample.time_s)
        if self._start_s is None and time_s == time_s:
            self._start_s = time_s
        return time_s - (self._start_s or 0.0)
