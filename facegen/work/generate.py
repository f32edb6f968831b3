"""Makes what a dataset is missing, and nothing else (``generate``)."""

import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace

from facegen.store import Dataset, begin, staging, sweep
from facegen.work.allocation import available_cpus, available_memory
from facegen.work.limits import Limits
from facegen.work.supervisor import Supervisor
from facegen.work.tasks import Task, done_tasks, quarantined_tasks, wanted_tasks

DEFAULT_GRACE_S = 30.0
MEMORY_SHARE = 0.8
"""A worker above this share of what it may take is renewed before the system kills it."""


@dataclass(frozen=True, kw_only=True)
class Work:
    """Tasks that a run has to make, and how many were there already."""

    missing: tuple[Task, ...]
    done: int
    quarantined: tuple[Task, ...]


@dataclass(frozen=True, kw_only=True)
class Summary:
    """Counts of a run: tasks made now, found made, quarantined before or now, and left by a stop."""

    made: int
    found: int
    quarantined: tuple[Task, ...]
    left: int


def plan_work(
    dataset: Dataset, ranges: str | None, *, shards: str | None = None, retry_quarantined: bool = False
) -> Work:
    """List what `generate` would do; reads the folder, writes nothing."""
    tasks = wanted_tasks(dataset, ranges, shards)
    done = done_tasks(dataset, tasks)
    missing = [task for task in tasks if task not in done]
    quarantined = set() if retry_quarantined else quarantined_tasks(dataset, missing)
    return Work(
        missing=tuple(task for task in missing if task not in quarantined),
        done=len(done),
        quarantined=tuple(task for task in missing if task in quarantined),
    )


def generate(
    dataset: Dataset,
    ranges: str | None = None,
    *,
    shards: str | None = None,
    workers: int | None = None,
    grace_s: float = DEFAULT_GRACE_S,
    limits: Limits = Limits(),
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
    shards
        Make exactly these keypoint shards (``"0-9"``, ``""`` for none), and without ``ranges`` no pictures.
    workers
        Processes at most; without, one per processor that this process may use. Fewer tasks need fewer, which
        share all processors and memory.
    grace_s
        Seconds that running tasks get to end after SIGINT or SIGTERM.
    limits
        When a worker is replaced, and when the run is given up.
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
    WorkersFailed
        If processes cannot start, or fail at nearly everything.
    """
    work = plan_work(dataset, ranges, shards=shards, retry_quarantined=retry_quarantined)
    begin(dataset)
    if not work.missing:
        return Summary(made=0, found=work.done, quarantined=work.quarantined, left=0)
    _check_writable(dataset)
    sweep(dataset.folder)
    if retry_quarantined:
        for task in work.missing:
            shutil.rmtree(dataset.folder.quarantine(task.name), ignore_errors=True)
    cpus = available_cpus()
    workers = min(workers or cpus, len(work.missing))
    share = int(MEMORY_SHARE * available_memory() / workers)
    supervisor = Supervisor(
        dataset=dataset,
        workers=workers,
        threads=max(1, cpus // workers),
        grace_s=grace_s,
        limits=replace(limits, memory=share if limits.memory is None else limits.memory),
        on_progress=on_progress,
    )
    try:
        outcome = supervisor.run(list(work.missing))
    finally:
        sweep(dataset.folder)  # what killed workers had begun
    return Summary(
        made=outcome.made,
        found=work.done + outcome.found,
        quarantined=(*work.quarantined, *outcome.quarantined),
        left=len(work.missing) - outcome.made - outcome.found - len(outcome.quarantined),
    )


def _check_writable(dataset: Dataset) -> None:
    """Try to make a stage before any process starts: a read-only folder is known at once."""
    with staging(dataset.folder, "probe") as stage:
        (stage / "probe").write_bytes(b"facegen")
