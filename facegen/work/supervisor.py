"""The supervisor: owns the worker processes, hands out tasks, tries again what failed, drains on request."""

import multiprocessing
import os
import shutil
import signal
import socket
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess

from facegen.errors import OutputError
from facegen.store import Dataset, output_errors
from facegen.work.child import Report, serve
from facegen.work.tasks import MAX_ATTEMPTS, Task

_TICK_S = 0.5


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """How a run ended."""

    made: int
    quarantined: tuple[Task, ...]
    drained: bool


@dataclass(eq=False)
class _Child:
    process: BaseProcess
    pipe: Connection
    task: Task | None = None


@dataclass(eq=False)
class Supervisor:
    """Runs tasks on worker processes, started by ``spawn``: a process forked from one with Blender in it hangs.

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
    on_progress
        Called with the number of finished tasks after each.
    """

    dataset: Dataset
    workers: int
    threads: int
    grace_s: float
    on_progress: Callable[[int], None]
    _children: list[_Child] = field(default_factory=list)
    _attempts: Counter = field(default_factory=Counter)
    _stop_at: float | None = None

    def run(self, tasks: list[Task]) -> Outcome:
        """Make all tasks; returns when all are made or quarantined, or when a request to stop was served.

        Raises
        ------
        OutputError
            If the folder cannot be written any more.
        """
        queue, made, quarantined = deque(tasks), 0, []
        with self._stop_on_signals(), self._processes():
            while (queue and not self._stopping) or any(child.task for child in self._children):
                if not self._stopping:
                    self._hand_out(queue)
                if self._stopping and time.monotonic() > self._stop_at:
                    break
                for report in self._reports():
                    if report.outcome == "done":
                        made += 1
                    elif report.outcome == "unwritable":
                        raise OutputError(report.message)
                    elif self._give_up(report):
                        quarantined.append(report.task)
                    else:
                        queue.append(report.task)
                    self.on_progress(made + len(quarantined))
        return Outcome(made=made, quarantined=tuple(quarantined), drained=made + len(quarantined) < len(tasks))

    @property
    def _stopping(self) -> bool:
        return self._stop_at is not None

    def _hand_out(self, queue: deque[Task]) -> None:
        while queue and len(self._children) < min(self.workers, len(queue) + sum(c.task is not None for c in self._children)):
            self._children.append(self._spawn())
        for child in self._children:
            if child.task is None and queue:
                child.task = queue.popleft()
                try:
                    child.pipe.send(child.task)
                except (BrokenPipeError, OSError):
                    pass  # it has died; its sentinel tells in the next round

    def _spawn(self) -> _Child:
        context = multiprocessing.get_context("spawn")
        ours, theirs = context.Pipe()
        log = self.dataset.folder.path / "logs" / f"worker-{socket.gethostname()}-{os.getpid()}-{time.time_ns()}.log"
        process = context.Process(
            target=serve, args=(theirs, str(self.dataset.folder.path), str(log), self.threads), daemon=True
        )
        process.start()
        theirs.close()
        return _Child(process, ours)

    def _reports(self) -> Iterator[Report]:
        handles = {child.pipe: child for child in self._children} | {c.process.sentinel: c for c in self._children}
        ready = {id(handles[handle]): handles[handle] for handle in wait(list(handles), timeout=_TICK_S)}
        for child in ready.values():
            try:
                report = child.pipe.recv() if child.pipe.poll() else None
            except (EOFError, OSError):
                report = None
            if report is not None:
                child.task = None
                yield report
            elif not child.process.is_alive():
                self._children.remove(child)
                if child.task is not None:
                    yield Report(child.task, "failed", f"the worker died with exit code {child.process.exitcode}")

    def _give_up(self, report: Report) -> bool:
        """Write the attempt's log; after the last attempt quarantine the task."""
        task, folder = report.task, self.dataset.folder
        self._attempts[task] += 1
        attempt = self._attempts[task]
        with output_errors(folder.path):
            log = folder.path / "logs" / f"{task.name}-attempt-{attempt}.log"
            log.parent.mkdir(parents=True, exist_ok=True)
            log.write_text(f"host {socket.gethostname()}, {time.strftime('%FT%T%z')}\n{report.message}\n", encoding="utf-8")
            if attempt < MAX_ATTEMPTS:
                return False
            place = folder.quarantine(task.name)
            place.mkdir(parents=True, exist_ok=True)
            for attempt_log in (folder.path / "logs").glob(f"{task.name}-attempt-*.log"):
                shutil.copy2(attempt_log, place)
        return True

    @contextmanager
    def _stop_on_signals(self) -> Iterator[None]:
        def stop(_signal: int, _frame: object) -> None:
            # a second request does not wait
            self._stop_at = time.monotonic() + (0.0 if self._stopping else self.grace_s)

        previous = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            yield
        finally:
            for number, handler in previous.items():
                signal.signal(number, handler)

    @contextmanager
    def _processes(self) -> Iterator[None]:
        try:
            yield
        finally:
            for child in self._children:
                if child.task is None and child.process.is_alive():
                    try:
                        child.pipe.send(None)
                    except (BrokenPipeError, OSError):
                        continue
            for child in self._children:
                child.process.join(timeout=0.0 if child.task is not None else 5.0)
                if child.process.is_alive():
                    child.process.kill()
                    child.process.join()
                child.pipe.close()
            self._children.clear()
