"""Makes what a dataset is missing, and nothing else (``generate``)."""

import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

from facegen.store import Dataset, begin, check_renderer, holds_dataset, staging, sweep, version_note
from facegen.work.allocation import available_cpus, available_memory, memory_note, memory_share, side_by_side
from facegen.work.limits import Limits
from facegen.work.supervisor import Supervisor
from facegen.work.tasks import Task, Wanted, done_tasks, quarantined_tasks, wanted_tasks

DEFAULT_GRACE_S = 30.0


@dataclass(frozen=True, kw_only=True)
class Work:
    """Tasks of a run, those of them that were there already, and those that failed for good."""

    wanted: Wanted
    found: frozenset[Task]
    quarantined: tuple[Task, ...]

    @property
    def done(self) -> int:
        """How many were there already."""
        return len(self.found)

    def left(self, kind: Literal["shard", "sample"]) -> int:
        """Count what has to be made of a kind, without listing it."""
        wanted = self.wanted.shards if kind == "shard" else self.wanted.samples
        return len(wanted) - sum(task.kind == kind for task in (*self.found, *self.quarantined))

    @cached_property
    def missing(self) -> tuple[Task, ...]:
        """What has to be made, listed.

        Raises
        ------
        InputError
            If that is more than `facegen.number_ranges.MOST_LISTED`.
        """
        others = self.found.union(self.quarantined)
        return tuple(task for task in self.wanted.tasks() if task not in others)


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
    wanted = wanted_tasks(dataset, ranges, shards)
    done = done_tasks(dataset, wanted)
    quarantined = set() if retry_quarantined else quarantined_tasks(dataset, wanted) - done
    in_order = sorted(quarantined, key=lambda task: (task.kind != "shard", task.number))
    return Work(wanted=wanted, found=frozenset(done), quarantined=tuple(in_order))


def check_versions(dataset: Dataset, work: Work) -> str:
    """See that what goes on with a dataset is what it was begun with; reads the folder, writes nothing.

    Returns
    -------
    str
        A sentence where it is not, but only last bits may differ.

    Raises
    ------
    InputError
        If pictures are missing, and another version of Blender would render them.
    """
    if not holds_dataset(dataset) or not work.missing:
        return ""
    if work.left("sample"):
        check_renderer(dataset)
    return version_note(dataset)


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
        If the folder holds a dataset of another spec, or one that another version of Blender has begun to render, or a
        sample does not exist.
    OutputError
        If the folder cannot be written.
    WorkersFailed
        If processes cannot start, or fail at nearly everything.
    """
    work = plan_work(dataset, ranges, shards=shards, retry_quarantined=retry_quarantined)
    missing = work.missing  # refused before anything is written where that is too much
    check_versions(dataset, work)
    begin(dataset)
    if not missing:
        return Summary(made=0, found=work.done, quarantined=work.quarantined, left=0)
    _check_writable(dataset)
    sweep(dataset.folder)
    if retry_quarantined:
        for task in missing:
            shutil.rmtree(dataset.folder.quarantine(task.name), ignore_errors=True)
    cpus = available_cpus()
    workers = _crew_size(work, workers, cpus)
    share = memory_share(available_memory(), workers)
    supervisor = Supervisor(
        dataset=dataset,
        workers=workers,
        threads=max(1, cpus // workers),
        grace_s=grace_s,
        limits=replace(limits, memory=share if limits.memory is None else limits.memory),
        on_progress=on_progress,
    )
    try:
        outcome = supervisor.run(list(missing))
    finally:
        sweep(dataset.folder)  # what killed workers had begun
    return Summary(
        made=outcome.made,
        found=work.done + outcome.found,
        quarantined=(*work.quarantined, *outcome.quarantined),
        left=len(missing) - outcome.made - outcome.found - len(outcome.quarantined),
    )


def crew_note(work: Work, workers: int | None) -> str:
    """A sentence where the workers of a run that renders have too little memory; nothing where they have enough."""
    if not work.left("sample"):
        return ""
    return memory_note(available_memory(), _crew_size(work, workers, available_cpus()))


def _crew_size(work: Work, workers: int | None, cpus: int) -> int:
    return min(side_by_side(workers or cpus), len(work.missing))


def _check_writable(dataset: Dataset) -> None:
    """Try to make a stage before any process starts: a read-only folder is known at once."""
    with staging(dataset.folder, "probe") as stage:
        (stage / "probe").write_bytes(b"facegen")
