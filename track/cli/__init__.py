"""The ``track`` command. Only this package prints: results to stdout, talk to stderr.

A command imports what it needs when it is called, so that ``--help`` is quick.
"""

import sys

from facegen.extras import LEARN, LIVE
from facegen.program import program
from facegen.program import run as run_program
from track.cli.calibrate import calibrate
from track.cli.compare import compare
from track.cli.devices import devices
from track.cli.profiles import profiles
from track.cli.record import record
from track.cli.run import run

app = program(
    "track",
    about="A camera in, an avatar's face out: live, on this machine alone. Without a command it is `track run`.",
    libraries=("numpy", "onnxruntime", "mediapipe"),
)
app.command()(run)
app.command()(calibrate)
app.command()(compare)
app.command()(devices)
app.command()(record)
app.add_typer(profiles, name="profiles")

_ITS_OWN = ("--help", "-h", "--version")
"""Words of the program itself."""


def main() -> None:
    """Entry point of the console script: what begins with no command is for `run`."""
    commands = {"run", "calibrate", "compare", "devices", "profiles", "record"}
    if len(sys.argv) < 2 or sys.argv[1] not in (*commands, *_ITS_OWN):
        sys.argv.insert(1, "run")
    run_program(app, extras=(LIVE, LEARN))
