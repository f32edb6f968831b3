"""Supervises a run: hands tasks to the worker processes, and drains on request."""

import contextlib
import shutil
import signal
import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from facegen.errors import OutputError
from facegen.store import Dataset
from facegen.work.backlog import Backlog
from facegen.work.child import Report, serve
from facegen.work.crew import Crew
from facegen.work.journal import Attempt, Journal
from facegen.work.limits import Limits
from facegen.work.process import WorkerProcess
from facegen.work.tasks import Task

_STOOD_STILL_S = 10.0
"""A round takes a tick and some; in a longer one this process was suspended, and its children with it."""

_SAME_REQUEST_S = 2.0
"""Signals closer than this are one request: scancel reaches this process itself and through its script."""


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """How a run ended: tasks made here, found made by others meanwhile, and failed for good."""

    made: int
    found: int
    quarantined: tuple[Task, ...]


class Supervisor:
    """Runs tasks on worker processes; lives in the main thread, since children die with the thread that made them.

    Parameters
    ----------
    dataset
        What to make; its folder must have been begun.
    workers
        Number of processes.
    threads
        Blender's threads in each.
    grace_s
        Time that running tasks get to end after a request to stop; then they are killed, and lost.
    limits
        When a worker is replaced, and when a run is given up.
    on_progress
        Called with the number of finished tasks after each.
    target
        What the children run.
    """

    def __init__(
        self,
        *,
        dataset: Dataset,
        workers: int,
        threads: int,
        grace_s: float,
        limits: Limits,
        on_progress: Callable[[int], None],
        target: Callable = serve,
    ) -> None:
        self._place: Path = dataset.folder.path
        self._workers, self._grace_s, self._on_progress = workers, grace_s, on_progress
        self._backlog = Backlog(dataset=dataset, most_failed=limits.failed_tasks, waiting=deque())
        self._crew = Crew(folder=dataset.folder, target=target, threads=threads, limits=limits)
        self._journal = Journal(dataset.folder)
        self._stop_at: float | None = None
        self._unwritable: str | None = None

    def run(self, tasks: list[Task]) -> Outcome:
        """Make all tasks; returns when all are made or quarantined, or when a request to stop was served.

        Raises
        ------
        OutputError
            If the folder cannot be written any more; running tasks got ``grace_s`` to end.
        WorkersFailed
            If processes cannot start, or fail at nearly everything.
        """
        backlog, crew = self._backlog, self._crew
        backlog.waiting.extend(tasks)
        last = time.monotonic()
        with self._stop_on_signals(), contextlib.ExitStack() as stack:
            stack.callback(crew.disband)
            while (backlog.waiting and not self._stopping) or crew.busy:
                now = time.monotonic()
                if self._stopping and now > self._stop_at:
                    break
                if now - last > _STOOD_STILL_S:
                    crew.excuse(now - last)
                last = now
                if not self._stopping:
                    crew.grow(self._workers, len(backlog.waiting))
                    self._hand_out()
                for worker, report in crew.reports():
                    self._take(worker, report)
                crew.kill_hung()
        if self._unwritable is not None:
            raise OutputError(self._unwritable)
        return Outcome(made=backlog.made, found=backlog.found, quarantined=tuple(backlog.quarantined))

    @property
    def _stopping(self) -> bool:
        return self._stop_at is not None

    def _stop(self, seconds: float) -> None:
        self._stop_at = min(time.monotonic() + seconds, self._stop_at or float("inf"))

    def _hand_out(self) -> None:
        for worker in self._crew.free():
            self._backlog.drop_found()
            if self._backlog.waiting and self._has_room():
                worker.assign(self._backlog.waiting.popleft(), self._crew.folder)

    def _has_room(self) -> bool:
        free, needed = shutil.disk_usage(self._place).free, 2 * self._workers * self._backlog.largest
        if free < needed:
            self._give_up_place(
                f"{self._place}: {free / 1e6:.1f} MB are left and the next results may need {needed / 1e6:.1f} MB; "
                "free some and run the same command again"
            )
        return free >= needed

    def _give_up_place(self, message: str) -> None:
        self._unwritable = self._unwritable or message
        self._stop(self._grace_s)

    @contextlib.contextmanager
    def _unwritable_gives_up(self) -> Iterator[None]:
        try:
            yield
        except OutputError as error:
            self._give_up_place(str(error))

    def _take(self, worker: WorkerProcess, report: Report) -> None:
        """Count a report, and do what follows from it."""
        seconds, cpu_seconds = worker.spent()
        task, worker.task = report.task, None
        worker.ended += 1
        # a process that dies while everything is being stopped was stopped, too
        outcome = "stopped" if self._stopping and report.outcome == "failed" else report.outcome
        attempt = Attempt(
            task=task.name,
            outcome=outcome,
            seconds=round(seconds, 3),
            cpu_seconds=round(cpu_seconds, 3),
            size=report.size,
            ended=round(time.time(), 3),
        )
        if outcome == "done":
            self._backlog.note_made(report.size)
        elif outcome == "unwritable":
            self._give_up_place(report.message)
        elif outcome == "failed":
            with self._unwritable_gives_up():
                self._backlog.note_failure(task, worker.task_log, report.message)
        with self._unwritable_gives_up():
            self._journal.add(attempt)
        self._on_progress(self._backlog.finished)
        self._crew.retire_if_worn(worker)

    @contextlib.contextmanager
    def _stop_on_signals(self) -> Iterator[None]:
        first = None

        def stop(_signal: int, _frame: object) -> None:
            nonlocal first
            first = first or time.monotonic()
            insisted = time.monotonic() - first > _SAME_REQUEST_S
            self._stop(0.0 if insisted else self._grace_s)  # a second request does not wait

        previous = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            yield
        finally:
            for number, handler in previous.items():
                signal.signal(number, handler)
