"""Checks avatars in a process of its own, one after the other, as standard input gives them.

In: u32 little endian, how many bytes, and the avatar. Out: the same before what is wrong with it, and of nothing where
it is whole.
"""

import os
import signal
import sys

from room.avatars.check import check_avatar
from room.errors import FormatError

LENGTH_BYTES = 4


def framed(content: bytes) -> bytes:
    """Bytes behind their length."""
    return len(content).to_bytes(LENGTH_BYTES, "little") + content


def examine() -> None:
    """Answer until standard input ends, as it does with the server."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to the server, which ends this
    if hasattr(os, "nice"):
        os.nice(10)  # people who meet go first
    while head := sys.stdin.buffer.read(LENGTH_BYTES):
        content, wrong = sys.stdin.buffer.read(int.from_bytes(head, "little")), ""
        try:
            check_avatar(content)
        except FormatError as error:
            wrong = str(error)
        sys.stdout.buffer.write(framed(wrong.encode()))
        sys.stdout.buffer.flush()
