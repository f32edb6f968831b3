"""Records what happened in a run, for `status` and for people: a line per attempt, and a log per attempt.

Nothing reads these files to decide what to make. Each is written by one process only, since appends of
several machines to one file of a file server get lost.
"""

import json
import os
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated

from pydantic import Field, TypeAdapter, ValidationError

from facegen.files import output_errors
from facegen.machine import machine_name
from facegen.store import DatasetFolder
from facegen.work.tasks import Task

LOGS_PER_FOLDER = 1000

MOST_LINE_BYTES = 4096
"""Of one attempt; its line has some 150."""

_Seconds = Annotated[float, Field(ge=0, allow_inf_nan=False)]


@dataclass(frozen=True, kw_only=True)
class Attempt:
    """One attempt at a task.

    Attributes
    ----------
    task
        Its name.
    outcome
        ``done``, ``failed``, ``unwritable``, or ``stopped`` where a drain did not wait for it.
    seconds, cpu_seconds
        By the clock, and of all the worker's threads.
    size
        Bytes written.
    ended
        Seconds since 1970.
    """

    task: str
    outcome: str
    seconds: _Seconds
    cpu_seconds: _Seconds
    size: Annotated[int, Field(ge=0)]
    ended: _Seconds


_ATTEMPT = TypeAdapter(Attempt)


class Journal:
    """File of one run, ``logs/run-….jsonl``; begun by its first line."""

    def __init__(self, folder: DatasetFolder) -> None:
        self.path = folder.path / "logs" / f"run-{machine_name()}-{os.getpid()}-{time.time_ns()}.jsonl"

    def add(self, attempt: Attempt) -> None:
        """Append one attempt.

        Raises
        ------
        OutputError
            If the file cannot be written.
        """
        with output_errors(self.path):
            self.path.parent.mkdir(parents=True, exist_ok=True)
            handle = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
            try:
                os.write(handle, (json.dumps(asdict(attempt)) + "\n").encode())
            finally:
                os.close(handle)


def read_journals(folder: DatasetFolder) -> Iterator[Attempt]:
    """All attempts of all runs in this dataset; lines that a kill or a full disk cut short are left out."""
    for path in sorted((folder.path / "logs").glob("run-*.jsonl")):
        if not path.is_file():  # a folder of such a name, a pipe, or a link to nothing
            continue
        with open(path, "rb") as file:
            while line := file.readline(MOST_LINE_BYTES):
                try:
                    yield _ATTEMPT.validate_json(line)
                except ValidationError:
                    continue


def attempt_log(folder: DatasetFolder, task: Task) -> Path:
    """Name of a new attempt's log: of this task, at this place and time."""
    name = f"{task.name}-{machine_name()}-{os.getpid()}-{time.time_ns()}.log"
    return folder.path / "logs" / f"{task.number // LOGS_PER_FOLDER:03d}" / name


def attempt_logs(folder: DatasetFolder, task: Task) -> list[Path]:
    """Logs of all attempts at a task, oldest first."""
    logs = (folder.path / "logs" / f"{task.number // LOGS_PER_FOLDER:03d}").glob(f"{task.name}-*.log")
    return sorted(logs, key=lambda path: path.stem.rsplit("-", 1)[-1])
