"""Holds one worker process for its supervisor: hands it tasks, measures its silence, processor time and memory."""

import multiprocessing
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path

import psutil

from facegen.children import block_stop_signals
from facegen.documents import last_lines
from facegen.errors import InputError
from facegen.machine import machine_name
from facegen.store import DatasetFolder
from facegen.work.child import Assignment, Phase, Ready, Report
from facegen.work.journal import attempt_log
from facegen.work.tasks import Task

_BUSY_CPU_S = 0.05
"""Processor time between two looks that counts as a sign of life; an idle Python process uses none."""

_KILL_WAIT_S = 5.0
"""A process in an uninterruptible wait (a file server that is away) outlives SIGKILL: it is left behind."""


@dataclass(eq=False)
class WorkerProcess:
    """One child, started by ``spawn``: a process forked from one with Blender in it hangs in a render."""

    process: BaseProcess
    pipe: Connection
    log: Path
    ready: bool = False
    task: Task | None = None
    task_log: Path | None = None
    ended: int = 0
    retiring: bool = False
    task_started: float = 0.0
    phase_started: float = field(default_factory=time.monotonic)
    _task_cpu_s: float = 0.0
    _alive_at: float = field(default_factory=time.monotonic)
    _alive_cpu_s: float = 0.0

    @classmethod
    def start(cls, folder: DatasetFolder, target: Callable, *, threads: int) -> "WorkerProcess":
        """Start a child that serves the dataset in ``folder``."""
        context = multiprocessing.get_context("spawn")
        ours, theirs = context.Pipe()
        log = folder.path / "logs" / f"worker-{machine_name()}-{os.getpid()}-{time.time_ns()}.log"
        arguments = (theirs, str(folder.path), str(log), threads, os.getpid())
        process = context.Process(target=target, args=arguments, daemon=True)
        with block_stop_signals():
            process.start()
        theirs.close()
        return cls(process, ours, log)

    def assign(self, task: Task, folder: DatasetFolder) -> None:
        """Hand out a task."""
        self.task, self.task_log = task, attempt_log(folder, task)
        self.task_started = self.phase_started = self._alive_at = time.monotonic()
        self._task_cpu_s = self.cpu_s()
        try:
            self.pipe.send(Assignment(task, self.task_log))
        except OSError:
            pass  # it has died; its sentinel tells in the next round

    def receive(self) -> Report | None:
        """Take what the child has sent, up to a report on its task; None without one."""
        try:
            while self.pipe.poll():
                message = self.pipe.recv()
                self.phase_started = self._alive_at = time.monotonic()
                if isinstance(message, Ready):
                    self.ready = True
                elif isinstance(message, Report):
                    return message
                else:
                    assert isinstance(message, Phase)
        except (EOFError, OSError):
            pass
        return None

    def spent(self) -> tuple[float, float]:
        """Seconds since the task was handed out, and processor seconds it took."""
        return time.monotonic() - self.task_started, max(0.0, self.cpu_s() - self._task_cpu_s)

    def silent_s(self) -> float:
        """Seconds since the last sign of life: a message, or processor time used.

        A render that takes an hour is busy; one that waits for a lock or was stopped is not.
        """
        cpu_s = self.cpu_s()
        if cpu_s - self._alive_cpu_s > _BUSY_CPU_S:
            self._alive_at, self._alive_cpu_s = time.monotonic(), cpu_s
        return time.monotonic() - self._alive_at

    def excuse(self, seconds: float) -> None:
        """Do not count a time in which the supervisor itself stood still, as in a suspended job."""
        self._alive_at += seconds
        self.phase_started += seconds

    def cpu_s(self) -> float:
        """Processor seconds of all threads so far; 0 where the system does not tell."""
        try:
            times = psutil.Process(self.process.pid).cpu_times()
        except psutil.Error:
            return 0.0
        return times.user + times.system

    def memory(self) -> int:
        """Resident bytes; 0 where the system does not tell."""
        try:
            return psutil.Process(self.process.pid).memory_info().rss
        except psutil.Error:
            return 0

    def retire(self) -> None:
        """Ask an idle child to end."""
        self.retiring = True
        try:
            self.pipe.send(None)
        except OSError:
            pass

    def end(self, wait_s: float) -> None:
        """Wait for the child, kill it if that takes too long, and close the pipe."""
        self.process.join(timeout=wait_s)
        if self.process.is_alive():
            self.process.kill()
            self.process.join(timeout=_KILL_WAIT_S)
        self.pipe.close()

    def log_tail(self, lines: int = 15) -> str:
        """Last lines of what the child printed outside tasks."""
        try:
            return "\n".join(last_lines(self.log, lines))
        except InputError:
            return "(no log)"
