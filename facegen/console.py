"""Shows a person at the terminal lines and progress, and ends a program with an exit code for every error."""

import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Annotated, TextIO

from facegen.errors import FacegenError, InputError
from facegen.extras import Extra, missing_extra

if TYPE_CHECKING:
    import typer

LINE_EVERY_S = 10.0
"""Without a terminal a line of progress is written at most this often, and at a stage's end."""

ProgressCall = Callable[[str, int, int], None]
"""Takes the name of a stage, the number of finished things, and how many there are."""


def say(message: str) -> None:
    """Write one line to standard error; a listener who has gone stops no work."""
    try:
        sys.stderr.write(f"{message}\n")
        sys.stderr.flush()
    except BrokenPipeError:
        hang_up(sys.stderr)


def hang_up(stream: TextIO) -> None:
    """Send nowhere what is left of a stream whose reader has gone: its end would complain again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def program(name: str, *, version: str, about: str, libraries: tuple[str, ...]) -> "typer.Typer":
    """Make a program without commands; it has ``--version``, and shows its help where nothing is asked of it.

    Parameters
    ----------
    name, version
        Of the program.
    about
        Sentence at the top of its help.
    libraries
        Distributions that its results depend on; ``--version`` names those that are installed.
    """
    import typer

    app = typer.Typer(
        name=name,
        help=about,
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )

    def print_version(asked: bool) -> None:
        if asked:
            typer.echo(f"{name} {version} ({_versions(libraries)})")
            raise typer.Exit

    flag = typer.Option(
        "--version",
        help="Print the versions that results depend on.",
        callback=print_version,
        is_eager=True,
    )

    @app.callback()
    def options(version: Annotated[bool, flag] = False) -> None:
        pass

    return app


def _versions(distributions: tuple[str, ...]) -> str:
    import importlib.metadata

    installed = []
    for name in distributions:
        with suppress(importlib.metadata.PackageNotFoundError):
            installed.append(f"{name} {importlib.metadata.version(name)}")
    return ", ".join([*installed, f"Python {sys.version.split()[0]}"])


def run(app: "typer.Typer", *, extras: tuple[Extra, ...]) -> None:
    """Run a program to its exit code, with one sentence for every error on purpose.

    Parameters
    ----------
    app
        The commands.
    extras
        Optional parts of the installation that commands may need: an absent one ends with exit code 2.
    """
    code: int | str | None = 0
    try:
        app()
    except FacegenError as error:
        say(f"{app.info.name}: {error}")
        code = int(error.exit_code)
    except ModuleNotFoundError as error:
        sentence = missing_extra(error, _command(app), extras)
        if sentence is None:
            raise
        say(f"{app.info.name}: {sentence}")
        code = InputError.exit_code
    except SystemExit as left:
        if isinstance(left.__context__, BrokenPipeError):
            hang_up(sys.stdout)  # its reader has gone, as `| head` does, of which Typer and rich make 1
        else:
            code = left.code
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        hang_up(sys.stdout)
    sys.exit(code)


def _command(app: "typer.Typer") -> str:
    """Program and sub-command that were called, ``facegen farm submit``."""
    from typer.main import get_command

    command, words = get_command(app), [app.info.name]
    for argument in sys.argv[1:]:
        command = getattr(command, "commands", {}).get(argument)
        if command is None:
            break
        words.append(argument)
    return " ".join(words)


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
    last = opened

    def write(stage: str, done: int, total: int) -> None:
        nonlocal last
        now = time.monotonic()
        # the first stage began with the command, a later one with its first call
        elapsed = now - started.setdefault(stage, now if started else opened)
        if done == total or now - last >= LINE_EVERY_S:
            last = now
            left = (
                f", about {elapsed / done * (total - done):.0f} s left"
                if done < total and done * elapsed
                else ""
            )
            say(f"{stage}: {done} of {total}{unit}, {elapsed:.0f} s{left}")

    return write


def _openjd_lines(stage: str, done: int, total: int) -> None:
    sys.stdout.write(f"openjd_progress: {100.0 * done / max(total, 1):.1f}\n")
    sys.stdout.write(f"openjd_status: {done} of {total} {stage}\n")
    sys.stdout.flush()
