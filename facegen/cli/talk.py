"""Talk to the person: one-liners on standard error; results go to standard output, and either may lose its reader."""

import os
import sys
from typing import TextIO


def say(message: str) -> None:
    """One line on standard error; a listener who has gone stops no work."""
    try:
        print(message, file=sys.stderr, flush=True)
    except BrokenPipeError:
        hang_up(sys.stderr)


def hang_up(stream: TextIO) -> None:
    """Send nowhere what is left of a stream whose reader has gone: its end would complain again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
