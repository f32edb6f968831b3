"""Stages half-made files of a dataset in its ``tmp/`` until they are whole, and sweeps those whose maker was killed."""

import contextlib
from collections.abc import Iterator
from pathlib import Path

from facegen import files
from facegen.store.folder import DatasetFolder


@contextlib.contextmanager
def staging(folder: DatasetFolder, name: str) -> Iterator[Path]:
    """A private folder below ``tmp/`` for half-made things; removed at the end, whatever happened.

    Raises
    ------
    OutputError
        If the system refuses to write there.
    """
    parent = folder.path / "tmp"
    with files.output_errors(parent):
        parent.mkdir(parents=True, exist_ok=True)
        with files.staging(parent, name) as path:
            yield path


def sweep(folder: DatasetFolder) -> int:
    """Remove half-made things that nobody makes any more; returns how many."""
    return files.sweep(folder.path / "tmp")
