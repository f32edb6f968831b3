"""Lists the tasks of a run and those that are missing: the folder's listing is the only state."""

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from facegen.conventions import SHARD_ROWS
from facegen.spec import sample_numbers
from facegen.store import Dataset

MAX_ATTEMPTS = 3
"""A task that failed this often is quarantined, and the rest goes on."""


@dataclass(frozen=True, order=True)
class Task:
    """One thing that appears on disk whole: a keypoint shard or a rendered sample."""

    kind: Literal["shard", "sample"]
    number: int

    @property
    def name(self) -> str:
        """Name in logs and in the quarantine."""
        return f"{self.kind}-{self.number:06d}"


def wanted_tasks(dataset: Dataset, ranges: str | None, shards: str | None = None) -> list[Task]:
    """All tasks of a run: the shards, longest work first, then the pictures.

    With ``ranges`` (``--samples``) these are the pictures of those samples, and the shards that hold them;
    with ``shards`` exactly those shards, and without ``ranges`` no pictures. An empty text means none.
    """
    numbers = [] if shards is not None and ranges is None else dataset.samples_to_render(ranges)
    if shards is not None:
        shard_numbers = sample_numbers(shards, total=dataset.shards, where="--shards", what="shard")
    else:
        shard_numbers = (
            range(dataset.shards) if ranges is None else sorted({number // SHARD_ROWS for number in numbers})
        )
    return [Task("shard", shard) for shard in shard_numbers] + [Task("sample", number) for number in numbers]


def task_path(dataset: Dataset, task: Task) -> Path:
    """Where a task's result appears."""
    folder = dataset.folder
    return folder.shard(task.number) if task.kind == "shard" else folder.render(task.number)


def is_done(dataset: Dataset, task: Task) -> bool:
    """Whether a task's result lies under its name, which means that it is complete."""
    return task_path(dataset, task).exists()


def done_tasks(dataset: Dataset, tasks: Iterable[Task]) -> set[Task]:
    """Those tasks whose results lie under their names; lists folders instead of asking for each name.

    A thousand names a listing: on a file server every question costs a round trip.
    """
    tasks = list(tasks)
    paths = {task: task_path(dataset, task) for task in tasks}
    listed = {parent: _names(parent) for parent in {path.parent for path in paths.values()}}
    return {task for task, path in paths.items() if path.name in listed[path.parent]}


def quarantined_tasks(dataset: Dataset, tasks: Iterable[Task]) -> set[Task]:
    """Those tasks that failed for good."""
    names = _names(dataset.folder.path / "quarantine")
    return {task for task in tasks if task.name in names}


def _names(folder: Path) -> set[str]:
    try:
        return set(os.listdir(folder))
    except (FileNotFoundError, NotADirectoryError):
        return set()
