"""Writes files that appear whole or not at all, and makes one sentence of the system's refusal to write.

For both programs. What is half-made lies in a private folder beside its place, named by who makes it; a writer who
was killed leaves it, and the next writer of the same file removes it.
"""

import contextlib
import ctypes
import errno
import hashlib
import os
import re
import shutil
import stat
import tempfile
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO

from facegen.errors import InputError, OutputError
from facegen.machine import is_alive, machine_name

STALE_AFTER_S = 24 * 3600.0
"""Half-made things of other machines, whose processes cannot be asked for, are removed at this age: no task
takes a day, and a maker that loses its half only makes it again."""

_OWN_HANDLE = re.compile(r"/dev/fd/(\d+)|/proc/(?:self|thread-self|\d+)/fd/(\d+)")
_NO_FLUSH = (errno.EINVAL, errno.ENOTSUP, errno.EBADF)
"""What systems say of a folder that they cannot flush."""

_MOST_LINKS = 40
"""Links to links that Linux follows, too."""


@contextlib.contextmanager
def output_errors(path: Path) -> Iterator[None]:
    """Turn the operating system's refusals to write into `OutputError`, with the place and the reason."""
    try:
        yield
    except OSError as error:
        # Windows knows no quota by this name
        if error.errno in (errno.ENOSPC, getattr(errno, "EDQUOT", None)):
            raise OutputError(f"{path}: no space left; free some and run the same command again") from error
        reason = os.strerror(error.errno) if error.errno else str(error)
        if error.errno == errno.EISDIR:
            raise OutputError(f"{path}: is a folder; name the file to write") from error
        if error.errno == errno.ENOENT and not path.parent.exists():
            raise OutputError(
                f"{path}: there is no folder {path.parent}; make it, or name another"
            ) from error
        raise OutputError(f"{path}: cannot be written ({reason}); choose another folder") from error


def refuse_ending(out: Path, *endings: str, what: str, option: str = "--out") -> None:
    """Refuse a name given as ``option`` that promises another kind of file than what is written.

    A device or a pipe (``/dev/stdout``) takes what comes; a folder is left to whoever writes.

    Raises
    ------
    InputError
        If ``out`` ends with none of ``endings``, whatever the case of its letters.
    """
    if out.suffix.lower() not in endings and (os.path.isfile(out) or not os.path.exists(out)):
        raise InputError(f"{option} is {out}; {what} ends with {' or '.join(endings)}: name such a file")


def refuse_sources(out: Path, sources: Iterable[Path], *, option: str = "--out") -> None:
    """Refuse to write over what the same command reads, by whatever name: a recording may have no other copy.

    Raises
    ------
    InputError
        Where ``out`` is one of them.
    """
    for source in sources:
        if os.path.isfile(out) and os.path.exists(source) and os.path.samefile(out, source):
            raise InputError(f"{option} {out} is also what is read ({source}); give another name")


def check_new_folder(folder: Path, *, what: str) -> None:
    """See that a folder can be made, before the work that fills it.

    Parameters
    ----------
    what
        It is for, as ``"the take"``.

    Raises
    ------
    InputError
        Where something of that name is there.
    OutputError
        Where there is no folder to make it in.
    """
    if folder.exists() or folder.is_symlink():
        raise InputError(f"{folder} is there already; name a new folder for {what}")
    if not folder.parent.is_dir():
        raise OutputError(f"{folder}: cannot be made, as there is no folder {folder.parent}")


@contextlib.contextmanager
def staging(parent: Path, name: str) -> Iterator[Path]:
    """A private folder below ``parent`` for half-made things; removed at the end, whatever happened.

    Its name ends with this machine, this process and the time, by which `sweep` knows whether anybody still makes it.
    """
    path = parent / f"{name}-{machine_name()}-{os.getpid()}-{time.time_ns()}"
    try:
        # not before: on a slow disk a stop falls into it, and the folder is made all the same; with parents, as an
        # equal run that ends may have removed the empty folder around it
        path.mkdir(parents=True)
        yield path
    finally:
        try:
            shutil.rmtree(path, ignore_errors=True)
        finally:
            shutil.rmtree(path, ignore_errors=True)  # where a stop fell into the first


def sweep(parent: Path, pattern: str = "*") -> int:
    """Remove half-made things below ``parent`` that nobody makes any more; returns how many.

    Those are the stages of dead processes of this machine, and of any machine after `STALE_AFTER_S`.
    """
    swept = 0
    for path in sorted(parent.glob(pattern)):
        if _abandoned(path):
            shutil.rmtree(path, ignore_errors=True)
            swept += not path.exists()
    return swept


def _abandoned(path: Path) -> bool:
    stem, *stamps = path.name.rsplit("-", 2)
    if len(stamps) == 2 and all(stamp.isdigit() for stamp in stamps):
        pid, since_ns = map(int, stamps)
        if stem.endswith(f"-{machine_name()}"):
            return not is_alive(pid, since_ns=since_ns)
    try:
        return time.time() - path.stat().st_mtime > STALE_AFTER_S
    except FileNotFoundError:
        return False


@contextlib.contextmanager
def whole_file(path: Path, *, suffix: str | None = None) -> Iterator[Path]:
    """Give another name to write to; what stands there at the end appears under ``path``, whole or not at all.

    An older file is replaced, and the new one has its mode. A link stays a link: the file it points to is replaced.
    A device, a pipe or an open handle (``/dev/stdout``) is no file and cannot be replaced: it takes the bytes.

    Parameters
    ----------
    path
        The file. Its folder must exist.
    suffix
        Of the name to write to, for writers that go by it; without, that of ``path``.

    Raises
    ------
    InputError
        If ``path`` is a folder.
    OutputError
        If the file cannot be written.
    """
    name = f"part{path.suffix if suffix is None else suffix}"
    with output_errors(path):
        if path.is_dir():
            raise InputError(f"{path}: is a folder; name the file to write")
        target = _replaceable(path)
        if target is None:
            with tempfile.TemporaryDirectory() as folder:
                yield Path(folder, name)
                with open(Path(folder, name), "rb") as made, _open_stream(path) as stream:
                    shutil.copyfileobj(made, stream)
            return
        if not target.parent.is_dir():
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
        stage = f".part-{hashlib.sha256(os.fsencode(target.name)).hexdigest()[:12]}"
        with staging(target.parent, stage) as folder:
            sweep(target.parent, f"{stage}-*")
            yield folder / name
            _copy_owner_and_mode(target, folder / name)
            sync(folder / name)
            os.replace(folder / name, target)


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


def _replaceable(path: Path) -> Path | None:
    """The regular or new file behind a name and its links; None for what can only be written through."""
    path = _behind_links(path)
    if _own_handle(path) is not None or (path.exists() and not path.is_file()):
        return None
    if path.exists() and not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    return path


def _open_stream(path: Path) -> BinaryIO:
    """Open what takes bytes and is no regular file; an open handle is used as it stands, at its own position."""
    path = _behind_links(path)
    handle = _own_handle(path)
    return os.fdopen(os.open(path, os.O_WRONLY) if handle is None else os.dup(handle), "wb")


def _behind_links(path: Path) -> Path:
    """What a link points to, link by link, up to an open handle: its own link does not say how to write to it."""
    for _ in range(_MOST_LINKS):
        if _own_handle(path) is not None or not path.is_symlink():
            break
        path = path.parent / os.readlink(path)
    return path


def _own_handle(path: Path) -> int | None:
    """Number of the open file of this process that a name such as ``/dev/fd/3`` stands for."""
    match = _OWN_HANDLE.fullmatch(os.path.abspath(path))
    return int(match[1] or match[2]) if match else None


def _copy_owner_and_mode(old: Path, new: Path) -> None:
    try:
        status = old.stat()
    except FileNotFoundError:
        return
    if hasattr(os, "chown"):
        with contextlib.suppress(OSError):  # only root may give a file away
            os.chown(new, status.st_uid, status.st_gid)
    os.chmod(new, stat.S_IMODE(status.st_mode))


def swap_folders(first: Path, second: Path) -> bool:
    """Exchange two folders of one file system in one step, so that neither name is ever empty.

    Returns
    -------
    bool
        Whether it was done: Linux and macOS can, and some file systems cannot.

    Raises
    ------
    OSError
        If one of the two does not exist, or may not be moved.
    """
    names = os.fsencode(first), os.fsencode(second)
    system = ctypes.CDLL(None, use_errno=True) if os.name == "posix" else None
    if hasattr(system, "renameat2"):
        at_here, exchange = -100, 2  # AT_FDCWD, RENAME_EXCHANGE of <linux/fs.h>
        failed = system.renameat2(at_here, names[0], at_here, names[1], exchange)
    elif hasattr(system, "renamex_np"):
        failed = system.renamex_np(*names, 2)  # RENAME_SWAP of macOS's <stdio.h>
    else:
        return False
    if failed:
        code = ctypes.get_errno()
        if code in (errno.EINVAL, errno.ENOSYS, errno.ENOTSUP):
            return False
        raise OSError(code, os.strerror(code), str(first))
    return True


def sync(path: Path) -> None:
    """Flush a file or folder to the disk, so that a rename after it never shows an empty file.

    A folder of a file system that flushes none (many a network's) is left to it.
    """
    if os.name == "nt" and path.is_dir():
        return  # Windows opens no folders
    # Windows flushes only what is open for writing
    handle = os.open(path, os.O_RDWR if os.name == "nt" else os.O_RDONLY)
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in _NO_FLUSH or not path.is_dir():
            raise
    finally:
        os.close(handle)
