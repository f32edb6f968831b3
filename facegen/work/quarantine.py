"""Writes why attempts failed into their logs, and puts the logs of what failed for good into the quarantine."""

import shutil
from pathlib import Path

from facegen.files import output_errors
from facegen.store import DatasetFolder, commit_folder, staging
from facegen.work.journal import attempt_logs
from facegen.work.tasks import Task


def end_log(log: Path, message: str) -> None:
    """Append why an attempt failed to its log; its process is dead or done and writes no more.

    Raises
    ------
    OutputError
        If the log cannot be written.
    """
    with output_errors(log):
        log.parent.mkdir(parents=True, exist_ok=True)  # the process may have died before its first word
        with log.open("a", encoding="utf-8") as handle:
            handle.write(f"{message}\n")


def quarantine(folder: DatasetFolder, task: Task) -> None:
    """Record that a task failed for good: a folder with the logs of all its attempts.

    Raises
    ------
    OutputError
        If the folder cannot be written.
    """
    with staging(folder, f"quarantine-{task.name}") as stage:
        for log in attempt_logs(folder, task):
            shutil.copyfile(log, stage / log.name)
        commit_folder(stage, folder.quarantine(task.name))
