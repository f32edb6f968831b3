"""Keeps a file that is being recorded under a private name beside its place, until it is whole."""

import contextlib
import itertools
import os
from collections.abc import Collection, Iterator
from pathlib import Path

from facegen.files import output_errors, sync, whole_file
from regress.runtime.sample import Sample


class Recording:
    """A file in the making; it appears by `keep`, or not at all.

    Parameters
    ----------
    path
        The file; its folder must exist.
    others
        Names in place of one that somebody else has taken in the meantime; without any, that file is replaced.

    Attributes
    ----------
    path
        The file; where there are others it is certain behind `keep`.
    part
        Where to write meanwhile: in a folder of this recording alone, where other files may lie too.

    Raises
    ------
    InputError, OutputError
        Where the file cannot be written.
    """

    def __init__(self, path: Path, others: Iterator[Path] | None = None) -> None:
        self.path, self._others = path, others
        self._whole = contextlib.ExitStack()
        self.part: Path = self._whole.enter_context(whole_file(path))

    def keep(self) -> None:
        """Give what was written its name."""
        if self._others is None:
            self._whole.close()
            return
        try:
            with output_errors(self.path):
                sync(self.part)
                while not _named(self.part, self.path):
                    self.path = next(self._others)
        finally:
            self.drop()

    def drop(self) -> None:
        """Remove what was written."""
        # as if the block of a `with` had raised: whole_file then names nothing
        self._whole.__exit__(_Dropped, _Dropped(), None)


class _Dropped(Exception):
    pass


def free_names(taken: Collection[Path] = ()) -> Iterator[Path]:
    """``track-001.csv``, ``track-002.csv`` …: names that no file has, each given once, from any thread.

    ``taken`` are whole paths that are spoken for, and appear later.
    """
    paths = map(Path, map("track-{:03d}.csv".format, itertools.count(1)))
    return filter(lambda path: not os.path.lexists(path) and Path(os.path.realpath(path)) not in taken, paths)


def _named(part: Path, path: Path) -> bool:
    """Give a file its name, unless something else has it; says whether it was given."""
    try:
        try:
            os.link(part, path)  # refuses a name that is taken, and never stands for half of a file
        except FileExistsError:
            return False
        except OSError:  # file systems without hard links: the name is held by an empty file for a moment
            os.close(os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY))
            os.replace(part, path)
    except FileExistsError:
        return False
    return True


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
