"""Writes files that appear whole or not at all, and makes one sentence of the system's refusal to write.

For both programs; nothing but the standard library.
"""

import contextlib
import errno
import os
from collections.abc import Iterator
from pathlib import Path

from facegen.errors import InputError, OutputError


@contextlib.contextmanager
def output_errors(path: Path) -> Iterator[None]:
    """Turn the operating system's refusals to write into `OutputError`, with the place and the reason."""
    try:
        yield
    except OSError as error:
        if error.errno in (
            errno.ENOSPC,
            getattr(errno, "EDQUOT", None),
        ):  # Windows knows no quota by this name
            raise OutputError(f"{path}: no space left; free some and run the same command again") from error
        reason = os.strerror(error.errno) if error.errno else str(error)
        raise OutputError(f"{path}: cannot be written ({reason}); choose another folder") from error


@contextlib.contextmanager
def whole_file(path: Path, *, suffix: str | None = None) -> Iterator[Path]:
    """Give another name to write to; what stands there at the end appears under ``path``, whole or not at all.

    Parameters
    ----------
    path
        The file; an older one is replaced. Its folder must exist.
    suffix
        Of the name to write to, for writers that go by it; without, that of ``path``.

    Raises
    ------
    InputError
        If ``path`` is a folder.
    OutputError
        If the file cannot be written.
    """
    with output_errors(path):
        if path.is_dir():
            raise InputError(f"{path}: is a folder; name the file to write")
        part = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix if suffix is None else suffix}")
        try:
            yield part
            sync(part)
            os.replace(part, path)
        finally:
            part.unlink(missing_ok=True)


def write_whole(path: Path, content: bytes | str) -> Path:
    r"""Write a file so that its name never stands for half of it; returns the name.

    Text is written as UTF-8 with ``\n`` line ends on every system, so that the bytes are the same everywhere.

    Raises
    ------
    OutputError
        If the file cannot be written, or ``path`` is a folder.
    """
    with output_errors(path):
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    with whole_file(path) as part:
        part.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def sync(path: Path) -> None:
    """Flush a file or folder to the disk, so that a rename after it never shows an empty file."""
    if os.name == "nt" and path.is_dir():
        return  # Windows opens no folders
    # Windows flushes only what is open for writing
    handle = os.open(path, os.O_RDWR if os.name == "nt" else os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
