"""Workers that misbehave in known ways, for the supervisor's tests; each is what a spawned child runs."""

import errno
import os
import signal
import sys
import time
from pathlib import Path

from facegen.errors import OutputError
from facegen.store import DatasetFolder, commit_folder, staging, write_json
from facegen.work.child import die_with_parent, serve_with


class Maker:
    """Makes samples of one small file; ``misbehave`` comes first."""

    def __init__(self, out: str) -> None:
        self.folder = DatasetFolder(Path(out))

    def make(self, task, on_phase) -> int:
        on_phase("begin")
        self.misbehave(task)
        with staging(self.folder, task.name) as stage:
            write_json(stage / "sample.json", {"process": os.getpid()})
            commit_folder(stage, self.folder.render(task.number))
        return 10

    def misbehave(self, task) -> None: ...

    def first_time(self, task) -> bool:
        mark = self.folder.path / "logs" / f"first-{task.name}"
        new = not mark.exists()
        mark.touch()
        return new


class Sound(Maker):
    pass


class FailsAtOdd(Maker):
    def misbehave(self, task):
        if task.number % 2:
            raise ValueError("odd numbers are not made")


class FailsAlways(Maker):
    def misbehave(self, task):
        raise ValueError("nothing is made")


class StopsOnce(Maker):
    """As in a lost wake-up or behind a file server that is away: alive, and idle."""

    def misbehave(self, task):
        if self.first_time(task):
            os.kill(os.getpid(), signal.SIGSTOP)


class LoopsOnce(Maker):
    def misbehave(self, task):
        while self.first_time(task):
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline:
                pass


class DiesOnce(Maker):
    def misbehave(self, task):
        if self.first_time(task):
            os.kill(os.getpid(), signal.SIGKILL)


class Grows(Maker):
    kept: bytes

    def misbehave(self, task):
        self.kept = b"x" * 200_000_000


class HiccupsOnce(Maker):
    """As behind a file server that answers late: something fails, and works the next time."""

    def misbehave(self, task):
        with staging(self.folder, "hiccup"):
            if self.first_time(task):
                raise OSError((errno.EIO, errno.ETIMEDOUT, errno.ENOENT)[task.number], "hiccup")


class MayNotWrite(Maker):
    def misbehave(self, task):
        with staging(self.folder, "refused"):
            raise OSError(errno.EACCES, "refused")


class FindsNoRoom(Maker):
    def misbehave(self, task):
        if task.number == 1:
            raise OutputError("no space left")
        time.sleep(0.5)


def _run(maker, pipe, out, log, parent) -> None:
    die_with_parent(parent)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    serve_with(maker(out), pipe, Path(out), Path(log))


def sound(pipe, out, log, threads, parent):
    _run(Sound, pipe, out, log, parent)


def fails_at_odd(pipe, out, log, threads, parent):
    _run(FailsAtOdd, pipe, out, log, parent)


def fails_always(pipe, out, log, threads, parent):
    _run(FailsAlways, pipe, out, log, parent)


def hiccups_once(pipe, out, log, threads, parent):
    _run(HiccupsOnce, pipe, out, log, parent)


def may_not_write(pipe, out, log, threads, parent):
    _run(MayNotWrite, pipe, out, log, parent)


def stops_once(pipe, out, log, threads, parent):
    _run(StopsOnce, pipe, out, log, parent)


def loops_once(pipe, out, log, threads, parent):
    _run(LoopsOnce, pipe, out, log, parent)


def dies_once(pipe, out, log, threads, parent):
    _run(DiesOnce, pipe, out, log, parent)


def grows(pipe, out, log, threads, parent):
    _run(Grows, pipe, out, log, parent)


def finds_no_room(pipe, out, log, threads, parent):
    _run(FindsNoRoom, pipe, out, log, parent)


def cannot_start(pipe, out, log, threads, parent):
    Path(log).parent.mkdir(parents=True, exist_ok=True)
    Path(log).write_text("libGL.so.1 is missing\n")
    sys.exit(3)
