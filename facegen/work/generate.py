"""``generate``: makes what a dataset is missing, and nothing else."""

import os
import shutil
from collections.abc import Callable
from dataclasses import dataclass

from facegen.store import Dataset, begin
from facegen.work.supervisor import Supervisor
from facegen.work.tasks import Task, is_done, is_quarantined, wanted_tasks

DEFAULT_GRACE_S = 30.0


@dataclass(frozen=True, kw_only=True)
class Work:
    """What a run has to do: tasks that are missing, and how many were there already."""

    missing: tuple[Task, ...]
    done: int
    quarantined: tuple[Task, ...]


@dataclass(frozen=True, kw_only=True)
class Summary:
    """What a run did: tasks made now, found made, quarantined before or now, and left because it was stopped."""

    made: int
    found: int
    quarantined: tuple[Task, ...]
    left: int


def available_cpus() -> int:
    """Processors that this process may use (a scheduler's allocation, not the machine's)."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def plan_work(dataset: Dataset, ranges: str | None, *, retry_quarantined: bool = False) -> Work:
    """What `generate` would do; reads the folder, writes nothing."""
    open_tasks = [task for task in wanted_tasks(dataset, ranges)]
    missing = [task for task in open_tasks if not is_done(dataset, task)]
    quarantined = () if retry_quarantined else tuple(task for task in missing if is_quarantined(dataset, task))
    return Work(
        missing=tuple(task for task in missing if task not in quarantined),
        done=len(open_tasks) - len(missing),
        quarantined=quarantined,
    )


def generate(
    dataset: Dataset,
    ranges: str | None = None,
    *,
    workers: int | None = None,
    grace_s: float = DEFAULT_GRACE_S,
    retry_quarantined: bool = False,
    on_progress: Callable[[int], None] = lambda done: None,
) -> Summary:
    """Make what is missing of a dataset.

    Parameters
    ----------
    dataset
        What to make, from `facegen.store.resolve`.
    ranges
        Samples to render (``"0-99,140"``); without, those that the spec names, and all keypoints.
    workers
        Processes; without, one per processor that this process may use.
    grace_s
        Seconds that running tasks get to end after SIGINT or SIGTERM.
    retry_quarantined
        Try again what failed three times in an earlier run.
    on_progress
        Called with the number of tasks finished in this run.

    Raises
    ------
    InputError
        If the folder holds a dataset of another spec, or a sample does not exist.
    OutputError
        If the folder cannot be written.
    """
    work = plan_work(dataset, ranges, retry_quarantined=retry_quarantined)
    begin(dataset)
    if not work.missing:
        return Summary(made=0, found=work.done, quarantined=work.quarantined, left=0)
    if retry_quarantined:
        for task in work.missing:
            shutil.rmtree(dataset.folder.quarantine(task.name), ignore_errors=True)
    cpus = available_cpus()
    workers = workers or cpus
    supervisor = Supervisor(
        dataset=dataset,
        workers=min(workers, len(work.missing)),
        threads=max(1, cpus // workers),
        grace_s=grace_s,
        on_progress=on_progress,
    )
    outcome = supervisor.run(list(work.missing))
    return Summary(
        made=outcome.made,
        found=work.done,
        quarantined=(*work.quarantined, *outcome.quarantined),
        left=len(work.missing) - outcome.made - len(outcome.quarantined),
    )
