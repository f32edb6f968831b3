"""Keeps the backlog of a run: tasks that wait, how those that ended went, what is tried again or quarantined."""

from collections import Counter, deque
from dataclasses import dataclass, field
from pathlib import Path

from facegen.errors import WorkersFailed
from facegen.store import Dataset
from facegen.work.quarantine import end_log, quarantine
from facegen.work.tasks import MAX_ATTEMPTS, Task, is_done


@dataclass(eq=False, kw_only=True)
class Backlog:
    """Tasks of one run.

    Attributes
    ----------
    dataset
        What the tasks are of.
    most_failed
        The run is given up when at least so many tasks failed for good, and more than were made.
    waiting
        Tasks that no worker is at.
    made, found
        Tasks made here, and found made by another supervisor meanwhile.
    largest
        Bytes of the largest result.
    quarantined
        Tasks that failed for good.
    """

    dataset: Dataset
    most_failed: int
    waiting: deque[Task]
    made: int = 0
    found: int = 0
    largest: int = 0
    quarantined: list[Task] = field(default_factory=list)
    _attempts: Counter[Task] = field(default_factory=Counter)

    @property
    def finished(self) -> int:
        """Tasks that nobody needs to make any more."""
        return self.made + self.found + len(self.quarantined)

    def drop_found(self) -> None:
        """Count and leave out the next tasks whose results are there: another supervisor was faster."""
        while self.waiting and is_done(self.dataset, self.waiting[0]):
            self.waiting.popleft()
            self.found += 1

    def note_made(self, size: int) -> None:
        """Count a task that was made; ``size`` is its result's in bytes."""
        self.made += 1
        self.largest = max(self.largest, size)

    def note_failure(self, task: Task, log: Path, message: str) -> None:
        """Queue a failed task again; after the last attempt quarantine it.

        Raises
        ------
        OutputError
            If its log or the quarantine cannot be written; the task waits again.
        WorkersFailed
            If nearly everything fails.
        """
        self._attempts[task] += 1
        attempt = self._attempts[task]
        self.waiting.append(task)
        end_log(log, f"attempt {attempt} of {MAX_ATTEMPTS} failed: {message}")
        if attempt < MAX_ATTEMPTS:
            return
        quarantine(self.dataset.folder, task)
        self.waiting.pop()
        self.quarantined.append(task)
        failed = len(self.quarantined)
        if failed >= self.most_failed and failed > self.made + self.found:
            raise WorkersFailed(
                f"{failed} things failed three times and only {self.made} were made, so the fault is not "
                f"theirs; the last said: {message.strip().splitlines()[-1]} (their logs are in "
                f"{self.dataset.folder.path}/quarantine; run with --retry-quarantined when it is mended)"
            )
