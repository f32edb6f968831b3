"""Progress of long work: a bar with rate and time left on a terminal, plain lines elsewhere."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from facegen.cli.talk import say
from facegen.errors import InputError

LINE_EVERY_S = 10.0
"""Without a terminal a line is written at most this often, and at the end."""


@contextmanager
def progress(what: str, total: int, *, style: str = "auto") -> Iterator[Callable[[int], None]]:
    """Gives a function that takes the number of finished things; shows it on stderr.

    Parameters
    ----------
    what
        Title, for example ``"samples"``.
    total
        Number of things there are.
    style
        ``"auto"``, or ``"openjd"``: lines on stdout that an OpenJD session shows as its task's progress.
    """
    if style not in ("auto", "openjd"):
        raise InputError(f"--progress is {style!r}, but must be auto or openjd")
    if style == "openjd":
        yield _openjd_lines(what, total)
        return
    console = Console(stderr=True)
    if console.is_terminal:
        columns = (
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TextColumn("{task.fields[rate]}"),
        )
        with Progress(*columns, TimeElapsedColumn(), TimeRemainingColumn(), console=console) as bar:
            task, started = bar.add_task(what, total=total, rate=""), time.monotonic()

            def update(done: int) -> None:
                rate = f"{done / max(time.monotonic() - started, 1e-9):.2f}/s"
                bar.update(task, completed=done, rate=rate)

            yield update
        return
    started = last = time.monotonic()

    def line(done: int) -> None:
        nonlocal last
        now = time.monotonic()
        if done == total or now - last >= LINE_EVERY_S:
            last, elapsed = now, now - started
            left = f", about {elapsed / done * (total - done):.0f} s left" if 0 < done < total else ""
            say(f"{what}: {done}/{total}, {elapsed:.0f} s{left}")

    yield line


def _openjd_lines(what: str, total: int) -> Callable[[int], None]:
    def tell(done: int) -> None:
        print(f"openjd_progress: {100.0 * done / max(total, 1):.1f}")
        print(f"openjd_status: {done} of {total} {what}", flush=True)

    tell(0)
    return tell
