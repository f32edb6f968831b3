"""The supervisor: owns the worker processes, hands out tasks, tries again what failed, drains on request."""

import contextlib
import os
import signal
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import wait

from facegen.errors import OutputError, WorkersFailed
from facegen.store import Dataset
from facegen.work.child import Report, serve
from facegen.work.journal import Attempt, Journal
from facegen.work.process import WorkerProcess
from facegen.work.quarantine import end_log, quarantine
from facegen.work.tasks import MAX_ATTEMPTS, Task, is_done

_TICK_S = 0.5
_STOOD_STILL_S = 10.0
"""A round takes a tick and some; in a longer one this process was suspended, and its children with it."""


_SAME_REQUEST_S = 2.0
"""Signals closer than this are one request: scancel reaches this process itself and through its script."""


@dataclass(frozen=True, kw_only=True)
class Limits:
    """When a worker is replaced, and when a run is given up.

    Attributes
    ----------
    silence_s
        A worker that for so long neither reports nor uses the processor hangs; it is killed, its task tried
        again.
    phase_s
        So long may one view or block take; an endless loop uses the processor, too.
    renew_after
        Tasks after which a process is renewed; a precaution, 300 renders left its size unchanged within 3 %.
    memory
        Bytes above which a process is renewed after its task; 0 for no limit, None for its share of what there is.
    failed_starts
        Starts that fail one after another before the run is given up.
    start_wait_s
        Pause after the first of them; it doubles each time.
    failed_tasks
        The run is given up when at least so many tasks failed for good, and more than were made.
    """

    silence_s: float = 300.0
    phase_s: float = 3600.0
    renew_after: int = 1000
    memory: int | None = None
    failed_starts: int = 5
    start_wait_s: float = 1.0
    failed_tasks: int = 10


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """How a run ended: tasks made here, found made by others meanwhile, and failed for good."""

    made: int
    found: int
    quarantined: tuple[Task, ...]


@dataclass(eq=False)
class Supervisor:
    """Runs tasks on worker processes; lives in the main thread, since children die with the thread that made
    them.

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

    dataset: Dataset
    workers: int
    threads: int
    grace_s: float
    limits: Limits
    on_progress: Callable[[int], None]
    target: Callable = serve
    _queue: deque[Task] = field(default_factory=deque)
    _children: list[WorkerProcess] = field(default_factory=list)
    _attempts: Counter = field(default_factory=Counter)
    _made: int = 0
    _found: int = 0
    _quarantined: list[Task] = field(default_factory=list)
    _largest: int = 0
    _failed_starts: int = 0
    _next_start: float = 0.0
    _stop_at: float | None = None
    _unwritable: str | None = None

    def run(self, tasks: list[Task]) -> Outcome:
        """Make all tasks; returns when all are made or quarantined, or when a request to stop was served.

        Raises
        ------
        OutputError
            If the folder cannot be written any more; running tasks got ``grace_s`` to end.
        WorkersFailed
            If processes cannot start, or fail at nearly everything.
        """
        self._queue.extend(tasks)
        self._journal = Journal(self.dataset.folder)
        last = time.monotonic()
        with self._stop_on_signals(), self._processes():
            while (self._queue and not self._stopping) or any(child.task for child in self._children):
                if self._stopping and time.monotonic() > self._stop_at:
                    break
                now = time.monotonic()
                if now - last > _STOOD_STILL_S:
                    for child in self._children:
                        child.excuse(now - last)
                last = now
                if not self._stopping:
                    self._fill_places()
                    self._hand_out()
                for child, report in self._reports():
                    self._take(child, report)
                self._watch()
        if self._unwritable is not None:
            raise OutputError(self._unwritable)
        return Outcome(made=self._made, found=self._found, quarantined=tuple(self._quarantined))

    @property
    def _stopping(self) -> bool:
        return self._stop_at is not None

    def _stop(self, seconds: float) -> None:
        self._stop_at = min(time.monotonic() + seconds, self._stop_at or float("inf"))

    def _fill_places(self) -> None:
        serving = [child for child in self._children if not child.retiring]
        busy = sum(child.task is not None for child in serving)
        missing = min(self.workers, len(self._queue) + busy) - len(serving)
        if time.monotonic() < self._next_start:
            return
        for _ in range(missing):
            child = WorkerProcess.start(self.dataset.folder, self.target, threads=self.threads)
            self._children.append(child)

    def _hand_out(self) -> None:
        for child in self._children:
            if child.ready and child.task is None and not child.retiring:
                while self._queue and is_done(self.dataset, self._queue[0]):  # another supervisor was faster
                    self._queue.popleft()
                    self._found += 1
                if self._queue and self._has_room():
                    child.assign(self._queue.popleft(), self.dataset.folder)

    def _has_room(self) -> bool:
        state = os.statvfs(self.dataset.folder.path)
        free, needed = state.f_bavail * state.f_frsize, 2 * self.workers * self._largest
        if free < needed:
            where = self.dataset.folder.path
            self._give_up_place(
                f"{where}: {free / 1e6:.1f} MB are left and the next results may need {needed / 1e6:.1f} MB; "
                "free some and run the same command again"
            )
        return free >= needed

    def _give_up_place(self, message: str) -> None:
        self._unwritable = self._unwritable or message
        self._stop(self.grace_s)

    def _reports(self) -> Iterator[tuple[WorkerProcess, Report]]:
        handles = {child.pipe: child for child in self._children} | {
            c.process.sentinel: c for c in self._children
        }
        ready = {id(handles[handle]): handles[handle] for handle in wait(list(handles), timeout=_TICK_S)}
        for child in ready.values():
            report = child.receive()
            if report is not None:
                yield child, report
            elif not child.process.is_alive():
                self._children.remove(child)
                child.end(0.0)
                if child.task is not None:
                    yield (
                        child,
                        Report(
                            child.task, "failed", f"the worker died with exit code {child.process.exitcode}"
                        ),
                    )
                elif not child.ready:
                    self._note_failed_start(child)

    def _note_failed_start(self, child: WorkerProcess) -> None:
        self._failed_starts += 1
        self._next_start = time.monotonic() + self.limits.start_wait_s * 2 ** (self._failed_starts - 1)
        if self._failed_starts >= self.limits.failed_starts:
            raise WorkersFailed(
                f"{self._failed_starts} worker processes one after another ended before they could work, the "
                f"last with exit code {child.process.exitcode}; it said:\n{child.log_tail()}"
            )

    def _take(self, child: WorkerProcess, report: Report) -> None:
        """Count a report, and do what follows from it."""
        seconds, cpu_seconds = child.spent()
        task, child.task = report.task, None
        child.ended += 1
        self._failed_starts = 0
        # a process that dies while everything is being stopped was stopped, too
        outcome = "stopped" if self._stopping and report.outcome == "failed" else report.outcome
        if outcome == "done":
            self._made += 1
            self._largest = max(self._largest, report.size)
        elif outcome == "unwritable":
            self._give_up_place(report.message)
        elif outcome == "failed":
            self._note_failure(child, report)
        self._write_journal(task, outcome, seconds, cpu_seconds, report.size)
        self.on_progress(self._made + self._found + len(self._quarantined))
        if child.process.is_alive() and self._is_worn(child):
            child.retire()

    def _is_worn(self, child: WorkerProcess) -> bool:
        return child.ended >= self.limits.renew_after or 0 < (self.limits.memory or 0) < child.memory()

    def _write_journal(self, task: Task, outcome: str, seconds: float, cpu_seconds: float, size: int) -> None:
        attempt = Attempt(
            task=task.name,
            outcome=outcome,
            seconds=round(seconds, 3),
            cpu_seconds=round(cpu_seconds, 3),
            size=size,
            ended=round(time.time(), 3),
        )
        try:
            self._journal.add(attempt)
        except OutputError as error:
            self._give_up_place(str(error))

    def _note_failure(self, child: WorkerProcess, report: Report) -> None:
        """Queue a failed task again; after the last attempt quarantine it."""
        task = report.task
        self._attempts[task] += 1
        try:
            attempt = f"attempt {self._attempts[task]} of {MAX_ATTEMPTS}"
            end_log(child.task_log, f"{attempt} failed: {report.message}")
            if self._attempts[task] == MAX_ATTEMPTS:
                quarantine(self.dataset.folder, task)
        except OutputError as error:
            self._queue.append(task)
            self._give_up_place(str(error))
            return
        if self._attempts[task] < MAX_ATTEMPTS:
            self._queue.append(task)
            return
        self._quarantined.append(task)
        failed = len(self._quarantined)
        if failed >= self.limits.failed_tasks and failed > self._made + self._found:
            raise WorkersFailed(
                f"{failed} things failed three times and only {self._made} were made, so the fault is not "
                f"theirs; the last said: {report.message.strip().splitlines()[-1]} (their logs are in "
                f"{self.dataset.folder.path}/quarantine; run with --retry-quarantined when it is mended)"
            )

    def _watch(self) -> None:
        """Kill what hangs; the next round finds it dead, and its task is tried again."""
        for child in self._children:
            if child.ready and child.task is None:
                continue  # waiting for work is no silence
            limits, busy_s = self.limits, time.monotonic() - child.phase_started
            if child.silent_s() > limits.silence_s:
                reason = f"no sign of life for {limits.silence_s:g} s"
            elif busy_s > limits.phase_s:
                reason = f"one step took more than {limits.phase_s:g} s"
            else:
                continue
            with contextlib.suppress(OutputError):  # a full disk must not keep a hung process alive
                end_log(child.task_log or child.log, f"killed by its supervisor: {reason}")
            child.process.kill()
            child.excuse(60.0)  # a process in an uninterruptible wait dies late

    @contextlib.contextmanager
    def _stop_on_signals(self) -> Iterator[None]:
        first = None

        def stop(_signal: int, _frame: object) -> None:
            nonlocal first
            first = first or time.monotonic()
            insisted = time.monotonic() - first > _SAME_REQUEST_S
            self._stop(0.0 if insisted else self.grace_s)  # a second request does not wait

        previous = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            yield
        finally:
            for number, handler in previous.items():
                signal.signal(number, handler)

    @contextlib.contextmanager
    def _processes(self) -> Iterator[None]:
        try:
            yield
        finally:
            for child in self._children:
                if child.ready and child.task is None:
                    child.retire()
            for child in self._children:
                child.end(5.0 if child.retiring else 0.0)
            self._children.clear()
