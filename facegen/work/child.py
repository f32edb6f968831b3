"""The child process of one worker: takes tasks from its supervisor's pipe, makes them, says how it went."""

import ctypes
import os
import signal
import sys
import traceback
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Literal

from facegen.errors import FacegenError, OutputError
from facegen.work.tasks import Task

_PR_SET_PDEATHSIG = 1


@dataclass(frozen=True)
class Report:
    """How one task went: ``done``, ``failed`` (worth another try) or ``unwritable`` (no task can succeed)."""

    task: Task
    outcome: Literal["done", "failed", "unwritable"]
    message: str = ""


def die_with_parent() -> None:
    """Ask Linux to kill this process when its parent dies; elsewhere a closed pipe ends it after its task."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def serve(pipe: Connection, out: str, log: str, threads: int) -> None:
    """Make tasks until the pipe says None or closes.

    Parameters
    ----------
    pipe
        Tasks come in, `Report` go out; before the first task ``None`` goes out when the worker is ready.
    out
        The dataset's folder; it must have been begun.
    log
        File that takes everything this process prints.
    threads
        Threads for Blender.
    """
    die_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches the whole group; the supervisor decides
    _redirect_output(Path(log))
    from facegen.store import open_dataset
    from facegen.work.worker import Worker

    worker = Worker(open_dataset(out), threads=threads)
    try:
        while (task := pipe.recv()) is not None:
            pipe.send(_attempt(worker, task))
    except (EOFError, BrokenPipeError):
        pass  # the supervisor is gone
    sys.stdout.flush()
    os._exit(0)  # Blender's own shutdown prints a traceback about a removed engine


def _attempt(worker: object, task: Task) -> Report:
    try:
        worker.make(task)
    except OutputError as error:
        return Report(task, "unwritable", str(error))
    except FacegenError as error:
        return Report(task, "failed", f"{error}\n\n{traceback.format_exc()}")
    except Exception:
        return Report(task, "failed", traceback.format_exc())
    return Report(task, "done")


def _redirect_output(log: Path) -> None:
    log.parent.mkdir(parents=True, exist_ok=True)
    handle = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    os.dup2(handle, 1)
    os.dup2(handle, 2)
    os.close(handle)
