"""Lists the tasks of a run and those that are missing: the folder's listing is the only state."""

import bisect
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from facegen.spec import listed, sample_ranges
from facegen.store import Dataset, shards_of
from facegen.store.folder import SAMPLES_PER_FOLDER

MAX_ATTEMPTS = 3
"""A task that failed this often is quarantined, and the rest goes on."""


@dataclass(frozen=True, order=True, slots=True)
class Task:
    """One thing that appears on disk whole: a keypoint shard or a rendered sample."""

    kind: Literal["shard", "sample"]
    number: int

    @property
    def name(self) -> str:
        """Name in logs and in the quarantine."""
        return f"{self.kind}-{self.number:06d}"


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """Numbers of the shards and pictures of a run; ranges, which are counted and not listed until they must be."""

    shards: Sequence[int]
    samples: Sequence[int]

    def __len__(self) -> int:
        return len(self.shards) + len(self.samples)

    def __contains__(self, task: Task) -> bool:
        return _holds(self.shards if task.kind == "shard" else self.samples, task.number)

    def tasks(self) -> Iterator[Task]:
        """All of them: the shards, longest work first, then the pictures.

        Raises
        ------
        InputError
            If they are more than `facegen.number_ranges.MOST_LISTED`.
        """
        shards = listed(self.shards, where="--shards", what="keypoint shard")
        samples = listed(self.samples, where="--samples", what="rendered sample")
        yield from (Task("shard", number) for number in shards)
        yield from (Task("sample", number) for number in samples)


def wanted_tasks(dataset: Dataset, ranges: str | None, shards: str | None = None) -> Wanted:
    """All tasks of a run.

    With ``ranges`` (``--samples``) these are the pictures of those samples, and the shards that hold them;
    with ``shards`` exactly those shards, and without ``ranges`` no pictures. An empty text means none.
    """
    numbers = [] if shards is not None and ranges is None else dataset.samples_to_render(ranges)
    if shards is not None:
        shard_numbers = sample_ranges(shards, total=dataset.shards, where="--shards", what="shard")
    else:
        shard_numbers = range(dataset.shards) if ranges is None else shards_of(numbers)
    return Wanted(shards=shard_numbers, samples=numbers)


def task_path(dataset: Dataset, task: Task) -> Path:
    """Where a task's result appears."""
    folder = dataset.folder
    return folder.shard(task.number) if task.kind == "shard" else folder.render(task.number)


def is_done(dataset: Dataset, task: Task) -> bool:
    """Whether a task's result lies under its name, which means that it is complete."""
    return task_path(dataset, task).exists()


def done_tasks(dataset: Dataset, wanted: Wanted) -> set[Task]:
    """Those tasks whose results lie under their names; lists folders instead of asking for each name.

    A thousand names a listing: on a file server every question costs a round trip.
    """
    folder = dataset.folder.path
    names = _names(folder / "keypoints") if wanted.shards else ()
    done = {Task("shard", number) for number in _numbers(names, r"shard-([0-9]{5,15})\.parquet")}
    for group in _numbers(_names(folder / "renders") if wanted.samples else (), "([0-9]{3,15})"):
        first = group * SAMPLES_PER_FOLDER
        if _any_in(wanted.samples, range(first, first + SAMPLES_PER_FOLDER)):
            numbers = _numbers(_names(dataset.folder.render(first).parent), "([0-9]{6,15})")
            done |= {Task("sample", number) for number in numbers if number // SAMPLES_PER_FOLDER == group}
    return {task for task in done if task in wanted}


def quarantined_tasks(dataset: Dataset, wanted: Wanted) -> set[Task]:
    """Those tasks that failed for good."""
    names = _names(dataset.folder.path / "quarantine")
    failed = {
        Task(kind, number)
        for kind in ("shard", "sample")
        for number in _numbers(names, f"{kind}-([0-9]{{6,15}})")
    }
    return {task for task in failed if task in wanted}


def _numbers(names: Iterable[str], pattern: str) -> set[int]:
    """Numbers in those names that are like a pattern."""
    return {int(match[1]) for name in names if (match := re.fullmatch(pattern, name))}


def _holds(numbers: Sequence[int], number: int) -> bool:
    if isinstance(numbers, range):
        return number in numbers
    place = bisect.bisect_left(numbers, number)
    return place < len(numbers) and numbers[place] == number


def _any_in(numbers: Sequence[int], span: range) -> bool:
    place = bisect.bisect_left(numbers, span.start)
    return place < len(numbers) and numbers[place] in span


def _names(folder: Path) -> set[str]:
    try:
        return set(os.listdir(folder))
    except (FileNotFoundError, NotADirectoryError):
        return set()
