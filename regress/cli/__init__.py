"""The ``regress`` command. Only this package prints: results to stdout, talk to stderr."""

import sys
from importlib.metadata import version as installed
from typing import Annotated

import typer

from facegen.formats import FormatError
from regress import __version__
from regress.cli.bench import bench
from regress.cli.edges import edges
from regress.cli.evaluate import evaluate
from regress.cli.export import export
from regress.cli.headset import headset
from regress.cli.predict import predict
from regress.cli.report import report
from regress.cli.talk import hang_up, say
from regress.cli.train import train
from regress.errors import RegressError

app = typer.Typer(
    name="regress",
    help="68 facial landmarks or a headset's pictures in, 52 blendshape weights out, learnt from synthetic people.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command()(train)
app.command()(evaluate)
app.command()(predict)
app.command()(export)
app.command()(report)
app.command()(bench)
app.command()(edges)
app.add_typer(headset)


def _print_version(wanted: bool) -> None:
    if wanted:
        parts = ", ".join(f"{name} {installed(name)}" for name in ("numpy", "scipy"))
        print(f"regress {__version__} ({parts}, Python {sys.version.split()[0]})")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", help="Print the versions that matter.", callback=_print_version, is_eager=True
        ),
    ] = False,
) -> None:
    pass


def main() -> None:
    """Entry point of the console script: one sentence and an exit code for every error on purpose."""
    code: int | str | None = 0
    try:
        app()
    except (RegressError, FormatError) as error:
        say(f"regress: {error}")
        code = int(error.exit_code)
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
