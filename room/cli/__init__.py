"""The ``room`` command. Only this package prints: results to stdout, talk to stderr."""

from facegen.extras import LEARN, REDIS, ROOM
from facegen.program import program, run
from room.cli.export import export
from room.cli.replay import replay
from room.cli.serve import serve
from room.cli.token import token
from room.cli.vectors import vectors

app = program(
    "room",
    about="People meet as avatars in the browser, with faces, gaze, voice and gestures.",
    libraries=("aiohttp",),
)
app.command()(serve)
app.command()(token)
app.command()(replay)
app.command()(export)
app.command()(vectors)


def main() -> None:
    """Entry point of the console script."""
    run(app, extras=(ROOM, REDIS, LEARN))
