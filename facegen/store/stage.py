"""Stages half-made files in ``tmp/`` until they are whole, and sweeps those whose maker was killed."""

import contextlib
import hashlib
import os
import shutil
import socket
import time
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import psutil

from facegen.files import output_errors
from facegen.store.folder import DatasetFolder

STALE_AFTER_S = 24 * 3600.0
"""Half-made things of other machines, whose processes cannot be asked for, are removed at this age: no task
takes a day, and a worker that loses its stage only makes its task again."""

_CLOCK_SLACK_NS = 2_000_000_000
"""The kernel tells its boot time in whole seconds, so that a process can seem to start later than it did."""


@cache
def place() -> str:
    """Name of this machine as its processes see it: equal only for processes that see each other's ids.

    Two containers may have one host name, and each its own process 7; the suffix tells them apart.
    """
    parts = []
    with contextlib.suppress(OSError):  # not Linux: the host name must do
        parts.append(Path("/proc/sys/kernel/random/boot_id").read_text())
        parts.append(os.readlink("/proc/self/ns/pid"))
    return f"{socket.gethostname()}.{hashlib.sha256(repr(parts).encode()).hexdigest()[:8]}"


@contextlib.contextmanager
def staging(folder: DatasetFolder, name: str) -> Iterator[Path]:
    """A private folder below ``tmp/`` for half-made things; removed at the end, whatever happened."""
    path = folder.path / "tmp" / f"{name}-{place()}-{os.getpid()}-{time.time_ns()}"
    with output_errors(path):
        path.mkdir(parents=True)
    try:
        with output_errors(path):
            yield path
    finally:
        shutil.rmtree(path, ignore_errors=True)


def sweep(folder: DatasetFolder) -> int:
    """Remove half-made things that nobody makes any more; returns how many.

    Those are the stages of dead processes of this machine, and of any machine after `STALE_AFTER_S`.
    """
    swept = 0
    for path in sorted((folder.path / "tmp").glob("*")):
        if _abandoned(path):
            shutil.rmtree(path, ignore_errors=True)
            swept += not path.exists()
    return swept


def is_alive(pid: int, *, since_ns: int | None = None) -> bool:
    """Whether a process of this machine runs, and (with ``since_ns``) already ran at that time of the clock.

    A zombie does not run, and a later process with the same number is another one.
    """
    try:
        process = psutil.Process(pid)
        runs = process.status() not in (psutil.STATUS_ZOMBIE, psutil.STATUS_DEAD)
        return runs and (since_ns is None or process.create_time() * 1e9 < since_ns + _CLOCK_SLACK_NS)
    except psutil.NoSuchProcess:
        return False


def _abandoned(path: Path) -> bool:
    stem, *stamps = path.name.rsplit("-", 2)
    if len(stamps) == 2 and all(stamp.isdigit() for stamp in stamps):
        pid, since_ns = map(int, stamps)
        if stem.endswith(f"-{place()}"):
            return not is_alive(pid, since_ns=since_ns)
    try:
        return time.time() - path.stat().st_mtime > STALE_AFTER_S
    except FileNotFoundError:
        return False
