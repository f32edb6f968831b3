"""Runs in a worker's process: takes tasks from its supervisor's pipe, makes them, reports how it went."""

import contextlib
import ctypes
import errno
import os
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Literal, Protocol

from facegen.children import ignore_stops
from facegen.errors import FacegenError, OutputError
from facegen.store import DatasetFolder, open_dataset, staging
from facegen.work.tasks import Task

_PR_SET_PDEATHSIG = 1

_NO_ROOM_BYTES = 65536
"""A file system with less than this free is full: the least sample.json alone has more."""

_PLACE_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EACCES, errno.EPERM, errno.ESTALE)
"""The system's errors that are the fault of the place, wherever in a task they come up; others may pass."""


@dataclass(frozen=True)
class Assignment:
    """A task to make, and the file that takes what is printed meanwhile."""

    task: Task
    log: Path


@dataclass(frozen=True)
class Ready:
    """The child has opened the dataset."""


@dataclass(frozen=True)
class Phase:
    """A sign of life: what the child begins to do now."""

    name: str


@dataclass(frozen=True)
class Report:
    """How one task went: ``done``, ``failed`` (worth another try) or ``unwritable`` (no task can succeed)."""

    task: Task
    outcome: Literal["done", "failed", "unwritable"]
    message: str = ""
    size: int = 0


class Maker(Protocol):
    """Maker of tasks: `facegen.work.worker.Worker`, or a test's."""

    def make(self, task: Task, on_phase: object) -> int:
        """Make one task; returns the bytes written."""


def die_with_parent(parent: int) -> None:
    """Ask Linux to kill this process when its parent dies; elsewhere a closed pipe ends it after its task.

    The parent may have died before the request: then nobody would send the signal.
    """
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:
            os._exit(1)


def serve(pipe: Connection, out: str, log: str, threads: int, parent: int) -> None:
    """Make tasks until the pipe says None or closes.

    Parameters
    ----------
    pipe
        `Assignment` come in; `Ready`, `Phase` and `Report` go out.
    out
        The dataset's folder; it must have been begun.
    log
        File that takes everything this process prints outside tasks.
    threads
        Threads for Blender.
    parent
        The supervisor's process.
    """
    die_with_parent(parent)
    ignore_stops()  # the supervisor decides, and kills
    _redirect_output(Path(log))
    from facegen.work.worker import Worker

    with _own_temporary_folder(DatasetFolder(Path(out))):
        serve_with(Worker(open_dataset(out), threads=threads), pipe, Path(out), Path(log))
    os._exit(0)  # Blender's own shutdown prints a traceback about a removed engine


def serve_with(maker: Maker, pipe: Connection, out: Path, log: Path) -> None:
    """Run the loop of `serve` with any maker of tasks."""
    try:
        pipe.send(Ready())
        while (assignment := pipe.recv()) is not None:
            pipe.send(_attempt(maker, assignment, pipe, out))
            _redirect_output(log)
    except (EOFError, BrokenPipeError, OSError):
        pass  # the supervisor is gone, or the disk full, which it has been told


@contextlib.contextmanager
def _own_temporary_folder(folder: DatasetFolder) -> Iterator[None]:
    """Let this process's temporary files lie where they are swept up if it is killed.

    Blender makes a folder as soon as it starts and removes it at its own shutdown, which a killed process never
    reaches: the nodes of a farm would collect one for every child.
    """
    with contextlib.ExitStack() as stack:
        try:
            tempfile.tempdir = str(stack.enter_context(staging(folder, "temporary")))
        except OutputError:
            pass  # no room even for a folder: the first task will meet that too, and say so
        else:
            os.environ["TMPDIR"] = tempfile.tempdir
        yield


def _attempt(maker: Maker, assignment: Assignment, pipe: Connection, out: Path) -> Report:
    task, started = assignment.task, time.monotonic()

    def on_phase(name: str) -> None:
        _say(f"[{time.monotonic() - started:.1f} s] {name}")
        pipe.send(Phase(name))

    try:
        _redirect_output(assignment.log)
        _say(f"{task.name}: process {os.getpid()}, {time.strftime('%FT%T%z')}")
        size = maker.make(task, on_phase)
    except BrokenPipeError:
        raise
    except Exception as error:
        reason = place_at_fault(error, out)
        if reason is not None:
            return Report(task, "unwritable", reason)
        sentence = f"{error}\n\n" if isinstance(error, FacegenError) else ""
        return Report(task, "failed", f"{sentence}{traceback.format_exc()}")
    _say(f"[{time.monotonic() - started:.1f} s] done, {size} bytes")
    return Report(task, "done", size=size)


def place_at_fault(error: BaseException, out: Path) -> str | None:
    """Why the place is to blame for an error and not the sample; None where it is not.

    A file server that hiccups is not: the task has more tries. Libraries in C++ report a full disk as an error of their
    own kind, so the disk itself is asked too.
    """
    causes = list(_causes(error))
    for cause in causes:
        if isinstance(cause, OSError) and cause.errno in _PLACE_ERRORS:
            told = isinstance(error, OutputError)
            return str(error) if told else f"{cause.filename or out}: {os.strerror(cause.errno)}"
    if isinstance(error, OutputError) and not any(isinstance(cause, OSError) for cause in causes):
        return str(error)
    try:
        free = shutil.disk_usage(out).free
    except OSError as gone:
        return f"{out}: {os.strerror(gone.errno)}"
    return (
        f"{out}: no space left; free some and run the same command again" if free < _NO_ROOM_BYTES else None
    )


def _causes(error: BaseException | None) -> Iterator[BaseException]:
    while error is not None:
        yield error
        error = error.__cause__ or error.__context__


def _say(line: str) -> None:
    try:
        sys.stdout.write(f"{line}\n")
        sys.stdout.flush()
    except OSError:
        pass  # a full disk: the task itself will meet it, and say so


def _redirect_output(log: Path) -> None:
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except OSError:
        pass
    system = ctypes.CDLL(None if os.name == "posix" else "ucrtbase")
    system.fflush(None)  # Blender prints through C, whose lines would end up in the next log
    log.parent.mkdir(parents=True, exist_ok=True)
    handle = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    os.dup2(handle, 1)
    os.dup2(handle, 2)
    os.close(handle)
