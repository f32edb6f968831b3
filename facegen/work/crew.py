"""Keeps the crew of a run: starts its worker processes, listens to them, kills those that hang, ends them."""

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import wait

from facegen.errors import OutputError, WorkersFailed
from facegen.store import DatasetFolder
from facegen.work.child import Report
from facegen.work.limits import Limits
from facegen.work.process import WorkerProcess
from facegen.work.quarantine import end_log

_TICK_S = 0.5

_DYING_S = 60.0
"""A killed process in an uninterruptible wait dies late: so long it is not found hanging again."""


@dataclass(eq=False, kw_only=True)
class Crew:
    """Worker processes of one dataset.

    Attributes
    ----------
    folder
        The dataset's.
    target
        What the processes run.
    threads
        Blender's threads in each.
    limits
        When one is replaced.
    members
        Processes that live, or whose end has not been seen.
    """

    folder: DatasetFolder
    target: Callable
    threads: int
    limits: Limits
    members: list[WorkerProcess] = field(default_factory=list)
    _failed_starts: int = 0
    _next_start: float = 0.0

    @property
    def busy(self) -> bool:
        """Whether any is at a task."""
        return any(worker.task for worker in self.members)

    def grow(self, most: int, waiting: int) -> None:
        """Start processes for ``waiting`` tasks, up to ``most`` in all; none in the pause after a failed start."""
        serving = [worker for worker in self.members if not worker.retiring]
        at_work = sum(worker.task is not None for worker in serving)
        missing = min(most, waiting + at_work) - len(serving)
        if time.monotonic() < self._next_start:
            return
        for _ in range(missing):
            self.members.append(WorkerProcess.start(self.folder, self.target, threads=self.threads))

    def free(self) -> list[WorkerProcess]:
        """Those that can take a task."""
        return [worker for worker in self.members if worker.ready and not worker.task and not worker.retiring]

    def reports(self) -> Iterator[tuple[WorkerProcess, Report]]:
        """Wait for a tick at most, and give what came in; a process that died reports its task as failed.

        Raises
        ------
        WorkersFailed
            If processes cannot start.
        """
        handles = {worker.pipe: worker for worker in self.members}
        handles |= {worker.process.sentinel: worker for worker in self.members}
        ready = {id(handles[handle]): handles[handle] for handle in wait(list(handles), timeout=_TICK_S)}
        for worker in ready.values():
            report = worker.receive()
            if report is None and not worker.process.is_alive():
                report = self._bury(worker)
            if report is not None:
                self._failed_starts = 0
                yield worker, report

    def _bury(self, worker: WorkerProcess) -> Report | None:
        self.members.remove(worker)
        worker.end(0.0)
        code = worker.process.exitcode
        if worker.task is not None:
            return Report(worker.task, "failed", f"the worker died with exit code {code}")
        if not worker.ready:
            self._failed_starts += 1
            self._next_start = time.monotonic() + self.limits.start_wait_s * 2 ** (self._failed_starts - 1)
            if self._failed_starts >= self.limits.failed_starts:
                raise WorkersFailed(
                    f"{self._failed_starts} worker processes one after another ended before they could work, "
                    f"the last with exit code {code}; it said:\n{worker.log_tail()}"
                )
        return None

    def retire_if_worn(self, worker: WorkerProcess) -> None:
        """Let a process end after so many tasks, or when it has grown."""
        worn = worker.ended >= self.limits.renew_after or 0 < (self.limits.memory or 0) < worker.memory()
        if worn and worker.process.is_alive():
            worker.retire()

    def kill_hung(self) -> None:
        """Kill what hangs; the next round finds it dead, and its task is tried again."""
        for worker in self.members:
            if worker.ready and worker.task is None:
                continue  # waiting for work is no silence
            limits, busy_s = self.limits, time.monotonic() - worker.phase_started
            if worker.silent_s() > limits.silence_s:
                reason = f"no sign of life for {limits.silence_s:g} s"
            elif busy_s > limits.phase_s:
                reason = f"one step took more than {limits.phase_s:g} s"
            else:
                continue
            with contextlib.suppress(OutputError):  # a full disk must not keep a hung process alive
                end_log(worker.task_log or worker.log, f"killed by its supervisor: {reason}")
            worker.process.kill()
            worker.excuse(_DYING_S)

    def excuse(self, seconds: float) -> None:
        """Do not count a time in which this process stood still, and its children with it."""
        for worker in self.members:
            worker.excuse(seconds)

    def disband(self) -> None:
        """End all: the idle by request, the rest by a kill."""
        for worker in self.members:
            if worker.ready and worker.task is None:
                worker.retire()
        for worker in self.members:
            worker.end(5.0 if worker.retiring else 0.0)
        self.members.clear()
