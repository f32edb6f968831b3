"""The ``track`` command. Only this package prints: results to stdout, talk to stderr.

A command imports what it needs when it is called, so that ``--help`` is quick.
"""

from facegen.extras import LIVE
from facegen.program import program, run
from track import __version__
from track.cli.devices import devices

app = program(
    "track",
    version=__version__,
    about="A camera in, an avatar's face out: live, on this machine alone.",
    libraries=("numpy", "onnxruntime", "mediapipe"),
)
app.command()(devices)


def main() -> None:
    """Entry point of the console script."""
    run(app, extras=(LIVE,))
