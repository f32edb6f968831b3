"""Shows a person at the terminal lines and progress, on standard error."""

import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TextIO

from facegen.errors import InputError

LINE_EVERY_S = 10.0
"""Without a terminal a line of progress is written at most this often, and at a stage's end."""

MOST_CHARACTERS = 500
"""Of a line for people; a file that is no text can stand in a message whole."""

ProgressCall = Callable[[str, int, int], None]
"""Takes the name of a stage, the number of finished things, and how many there are."""


def say(message: str) -> None:
    """Write one line to standard error; a listener who has gone stops no work, nor does a full disk under a log."""
    try:
        sys.stderr.write(f"{one_line(message)}\n")
        sys.stderr.flush()
    except BrokenPipeError:
        redirect_to_devnull(sys.stderr)
    except OSError:  # what waits goes with a later line, once there is space again
        return


def counted(count: int, one: str, many: str = "") -> str:
    """A number with its noun: ``"1 file"``, ``"2,000 files"``; ``many`` where it is not ``one`` with an s."""
    return f"{count:,} {one if count == 1 else many or f'{one}s'}"


def one_line(message: str) -> str:
    """The message in one line of at most `MOST_CHARACTERS`: what a terminal would act on is escaped, the middle cut.

    The end stays, as it says what to do.
    """
    text = " ".join(message.split())
    text = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
    if len(text) > MOST_CHARACTERS:
        end = MOST_CHARACTERS // 3
        text = f"{text[: MOST_CHARACTERS - end - 3]} … {text[-end:]}"
    return text


def redirect_to_devnull(stream: TextIO) -> None:
    """Send nowhere what is left of a stream whose reader has gone: its end would complain again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


@contextmanager
def silent_stderr() -> Iterator[None]:
    """Discard what C libraries print on standard error, whose talk no option of theirs turns off.

    OpenCV complains of a tag that WebM does not have, whatever the tag; MediaPipe of its own models.
    """
    sys.stderr.flush()
    kept, null = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(null, 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(null)


@contextmanager
def progress(*, unit: str = "", style: str = "auto") -> Iterator[ProgressCall]:
    """Give a function that shows progress on standard error: bars on a terminal, plain lines elsewhere.

    The function may be called by several threads, and for several stages.

    Parameters
    ----------
    unit
        Word after the numbers, for example ``"steps"``; without, the stage's name says what is counted.
    style
        ``"auto"``, or ``"openjd"``: lines on standard output that an OpenJD session shows as its task's progress.
    """
    if style not in ("auto", "openjd"):
        raise InputError(f"--progress is {style!r}, but must be auto or openjd")
    unit = unit and f" {unit}"
    if style == "openjd":
        yield _openjd_lines
    elif sys.stderr.isatty():
        with _bars(unit) as draw:
            yield draw
    else:
        yield _plain_lines(unit)


@contextmanager
def _bars(unit: str) -> Iterator[ProgressCall]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn(f"{{task.completed}}/{{task.total}}{unit}"),
        TextColumn("{task.fields[rate]}"),
    )
    tasks, lock = {}, threading.Lock()
    with Progress(*columns, TimeElapsedColumn(), TimeRemainingColumn(), console=Console(stderr=True)) as bars:

        def draw(stage: str, done: int, total: int) -> None:
            with lock:
                if stage not in tasks:
                    tasks[stage] = bars.add_task(stage, total=total, rate=""), time.monotonic()
            task, started = tasks[stage]
            rate = f"{done / max(time.monotonic() - started, 1e-9):.2f}/s"
            bars.update(task, completed=done, rate=rate)

        yield draw


def _plain_lines(unit: str) -> ProgressCall:
    opened = time.monotonic()
    started: dict[str, float] = {}
    first: dict[str, tuple[int, float]] = {}
    last = opened

    def write(stage: str, done: int, total: int) -> None:
        nonlocal last
        now = time.monotonic()
        # the first stage began with the command, a later one with its first call
        elapsed = now - started.setdefault(stage, now if started else opened)
        # what is there already, or took its time to begin with, says nothing of the pace
        before, since = first.setdefault(stage, (done, now))
        if done == total or now - last >= LINE_EVERY_S:
            last = now
            left = ""
            if before < done < total and now > since:
                left = f", about {_spoken((now - since) / (done - before) * (total - done))} left"
            say(f"{stage}: {done} of {total}{unit}, {_spoken(elapsed)}{left}")

    return write


def _spoken(seconds: float) -> str:
    """A length of time as people say it."""
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def _openjd_lines(stage: str, done: int, total: int) -> None:
    sys.stdout.write(f"openjd_progress: {100.0 * done / max(total, 1):.1f}\n")
    sys.stdout.write(f"openjd_status: {done} of {total} {stage}\n")
    sys.stdout.flush()
