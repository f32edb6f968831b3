"""Defines ``room vectors``."""

import sys


def vectors() -> None:
    """Print the test vectors of the wire message, for whoever writes a reader or a sender in another language.

    Example: room vectors > room/protocol/vectors.json
    """
    from room.protocol.vectors import text

    sys.stdout.write(text())
