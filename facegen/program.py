"""Makes a program of commands and runs it: every end has an exit code, and every fault is one sentence."""

import errno
import functools
import math
import os
import platform
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Any

from facegen.children import answer_stops
from facegen.console import redirect_to_devnull, say
from facegen.errors import ExitCode, FacegenError, InputError
from facegen.extras import Extra, missing_extra
from facegen.redaction import text_without_secrets, without_secrets
from facegen.version import __version__

if TYPE_CHECKING:
    import typer

_UNREACHABLE = (errno.ENAMETOOLONG, errno.ELOOP, errno.EACCES)
"""What the system says of names that lead nowhere, wherever a command first asks whether something stands there."""

_KEYBOARD_INTERRUPT = 130
"""What Typer makes of a KeyboardInterrupt."""

_IMPORTS = "<frozen importlib._bootstrap>"
"""File of the code that is at work while a module loads."""

STOPPED = "stopped; run the same command again"


def program(name: str, *, about: str, libraries: tuple[str, ...]) -> "typer.Typer":
    """Make a program without commands; it has ``--version``, and shows its help where nothing is asked of it.

    Parameters
    ----------
    name
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
            typer.echo(f"{name} {__version__} ({_versions(libraries)})")
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
    """Run a program to its exit code, with one sentence for every error.

    Ctrl-C and SIGTERM stop it with 75. What nobody foresaw ends it with 70, and its traceback lies in a file that the
    sentence names: a traceback's exit code is 1, by which farms would take it for quarantined samples.

    Parameters
    ----------
    app
        The commands.
    extras
        Optional parts of the installation that commands may need: an absent one ends with exit code 2.
    """
    end_on_stops(app.info.name)
    if sys.stdout is not None:
        with suppress(AttributeError, ValueError):
            sys.stdout.reconfigure(errors="surrogateescape")  # names that are no UTF-8 come out as they are
    try:
        code = _run_command(app, extras)
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:  # the reader has gone, as `| head` does
        redirect_to_devnull(sys.stdout)
        code = ExitCode.OK
    except OSError as error:
        code = _fault(app, error)
    sys.exit(int(code))


def end_on_stops(name: str) -> None:
    """Let Ctrl-C and SIGTERM end this process as `run` says; to be called before the first library loads."""

    def stop(_number: int, frame: FrameType | None) -> None:
        while frame is not None:
            if frame.f_code.co_filename == _IMPORTS:
                # compiled modules make an error of their own of what is raised while they load; nothing is half-made
                say(f"{name}: {STOPPED}")
                os._exit(ExitCode.DRAINED)
            frame = frame.f_back
        raise KeyboardInterrupt

    with suppress(ValueError):  # not the main thread, where signals are nobody's
        answer_stops(stop)


def _run_command(app: "typer.Typer", extras: tuple[Extra, ...]) -> int:
    """Run the command that was asked for; its exit code, and its error has been said."""
    import typer

    name = app.info.name
    # click's, of which Typer has its own copy
    usage_error = typer.BadParameter.__mro__[2]
    try:
        code = commands(app)(standalone_mode=False)
    except FacegenError as error:
        say(f"{name}: {error}")
        return error.exit_code
    except usage_error as error:
        return _misused(app, error)
    except typer.Abort as error:
        # Typer takes a file that ends too soon for a person who leaves
        if isinstance(error.__cause__, EOFError):
            return _fault(app, error.__cause__)
        code = _KEYBOARD_INTERRUPT
    except KeyboardInterrupt:
        code = _KEYBOARD_INTERRUPT
    except SystemExit as left:
        if isinstance(left.__context__, BrokenPipeError):  # of which Typer and rich make 1
            raise left.__context__ from None
        code = left.code
    except ModuleNotFoundError as error:
        return _absent(app, error, extras)
    except BrokenPipeError:
        raise
    except Exception as error:
        return _fault(app, error)
    if code == _KEYBOARD_INTERRUPT:
        say(f"{name}: {STOPPED}")
        return ExitCode.DRAINED
    return code if isinstance(code, int) else ExitCode.OK


@functools.cache
def commands(app: "typer.Typer") -> Any:
    """Commands of a program, made once a process: that takes as long as the shortest of them."""
    from typer.main import get_command

    return _finite_numbers(get_command(app))


def _finite_numbers(command: Any) -> Any:
    """Let no option of a command or of those below it take infinity or NaN, which pass bounds and mean nothing."""
    for parameter in command.params:
        parameter.process_value = _finite(parameter)
    for inner in getattr(command, "commands", {}).values():
        _finite_numbers(inner)
    return command


def _finite(parameter: Any) -> Callable[[Any, Any], Any]:
    import typer

    process = parameter.process_value

    def finite(context: Any, value: Any) -> Any:
        processed = process(context, value)
        if isinstance(processed, float) and not math.isfinite(processed):
            raise typer.BadParameter(f"{value!r} is not a finite number.", ctx=context, param=parameter)
        return processed

    return finite


def _absent(app: "typer.Typer", error: ModuleNotFoundError, extras: tuple[Extra, ...]) -> int:
    """Say how to get a part of the installation; a module that belongs to none is a fault."""
    sentence = missing_extra(error, _command(app), extras)
    if sentence is None:
        return _fault(app, error)
    say(f"{app.info.name}: {sentence}")
    return InputError.exit_code


def _misused(app: "typer.Typer", error: Any) -> int:
    """Say what is wrong with the words that the program was called with; without any, show its help."""
    if type(error).__name__ == "NoArgsIsHelpError":
        error.show()
    else:
        # Typer's copy of click puts pydantic's words before its own
        message = error.format_message().replace("Value error, ", "").rstrip(".")
        message = message.removesuffix(" (Possible options: --help)").replace(
            ": Input should be", ": it should be"
        )
        say(f"{app.info.name}: {message}; see {_command(app)} --help")
    return InputError.exit_code


def _fault(app: "typer.Typer", error: Exception) -> int:
    """Say in one sentence what nobody foresaw, and keep its traceback in a file."""
    name = app.info.name
    if isinstance(error, OSError) and error.errno in (errno.ENOSPC, getattr(errno, "EDQUOT", None)):
        redirect_to_devnull(sys.stdout)  # what could not be written would be tried again at the end
        say(
            f"{name}: {error.filename or 'standard output'}: no space left; free some and run the same command again"
        )
        return ExitCode.NOT_WRITABLE
    if isinstance(error, OSError) and error.errno in _UNREACHABLE and error.filename is not None:
        say(f"{name}: {os.fsdecode(error.filename)}: cannot be reached ({error.strerror}); name another")
        return InputError.exit_code
    try:
        handle, path = tempfile.mkstemp(prefix=f"{name}-fault-", suffix=".txt")
        with open(handle, "w", encoding="utf-8", errors="backslashreplace") as file:
            file.write(f"{name}, {time.strftime('%FT%T%z')}, {platform.platform()}, Python {sys.version}\n")
            file.write(f"{[without_secrets(word) for word in sys.argv]}\n{os.getcwd()}\n\n")
            file.write(text_without_secrets("".join(traceback.format_exception(error)), sys.argv[1:]))
        kept = f"details are in {path}; please report it with them"
    except OSError:
        frame = traceback.extract_tb(error.__traceback__)[-1]
        kept = f"in {os.path.basename(frame.filename)}, line {frame.lineno}; please report it"
    if isinstance(error, MemoryError):
        say(f"{name}: memory ran out; give it more, or less to do at once ({kept})")
    else:
        told = text_without_secrets(str(error), sys.argv[1:])[:200]
        say(f"{name}: internal error ({type(error).__name__}: {told}); {kept}")
    return ExitCode.INTERNAL


def _command(app: "typer.Typer") -> str:
    """Program and sub-command that were called, ``facegen farm submit``."""
    command, words = commands(app), [app.info.name]
    for argument in sys.argv[1:]:
        command = getattr(command, "commands", {}).get(argument)
        if command is None:
            break
        words.append(argument)
    return " ".join(words)
