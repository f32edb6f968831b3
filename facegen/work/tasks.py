"""What there is to make, and what of it is missing: the folder's listing is the only state."""

from dataclasses import dataclass
from typing import Literal

from facegen.conventions import SHARD_ROWS
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


def wanted_tasks(dataset: Dataset, ranges: str | None) -> list[Task]:
    """All tasks of a run: the shards, longest work first, then the pictures.

    With ``ranges`` (``--samples``) these are the pictures of those samples, and the shards that hold them.
    """
    numbers = dataset.samples_to_render(ranges)
    shards = range(dataset.shards) if ranges is None else sorted({number // SHARD_ROWS for number in numbers})
    return [Task("shard", shard) for shard in shards] + [Task("sample", number) for number in numbers]


def is_done(dataset: Dataset, task: Task) -> bool:
    """Whether a task's result lies under its name, which means that it is complete."""
    folder = dataset.folder
    return (folder.shard(task.number) if task.kind == "shard" else folder.render(task.number)).exists()


def is_quarantined(dataset: Dataset, task: Task) -> bool:
    """Whether a task failed for good."""
    return dataset.folder.quarantine(task.name).exists()
