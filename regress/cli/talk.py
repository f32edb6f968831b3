"""Talk to the person: one-liners and progress on standard error, results on standard output."""

import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from regress.learning.training.fitting import Progress as ProgressCall

_PLAIN_SECONDS = 10.0
"""Between two plain progress lines: a log of a long run stays short."""


def say(message: str) -> None:
    """One line on standard error; a listener who has gone stops no work."""
    try:
        print(message, file=sys.stderr, flush=True)
    except BrokenPipeError:
        hang_up(sys.stderr)


def hang_up(stream: TextIO) -> None:
    """Send nowhere what is left of a stream whose reader has gone: its end would complain again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


@contextmanager
def progress() -> Iterator[ProgressCall]:
    """A callback that draws a bar on a terminal and plain lines elsewhere."""
    if sys.stderr.isatty():
        columns = (
            TextColumn("{task.description}"),
            BarColumn(),
            TextColumn("{task.completed}/{task.total} steps"),
            TimeElapsedColumn(),
            TimeRemainingColumn(),
        )
        with Progress(*columns, console=Console(stderr=True)) as bar:
            tasks: dict[str, int] = {}
            lock = threading.Lock()

            def draw(stage: str, done: int, total: int) -> None:
                with lock:
                    if stage not in tasks:
                        tasks[stage] = bar.add_task(stage, total=total)
                bar.update(tasks[stage], completed=done)

            yield draw
        return
    last = [time.monotonic()]

    def write(stage: str, done: int, total: int) -> None:
        if done == total or time.monotonic() - last[0] > _PLAIN_SECONDS:
            last[0] = time.monotonic()
            say(f"{stage}: {done} of {total} steps")

    yield write
