"""Names this machine as its processes see it, and tells which of its processes still run."""

import contextlib
import hashlib
import os
import socket
from functools import cache
from pathlib import Path

_CLOCK_SLACK_NS = 2_000_000_000
"""The kernel tells its boot time in whole seconds, so that a process can seem to start later than it did."""


@cache
def machine_name() -> str:
    """Name that is equal only for processes that see each other's ids.

    Two containers may have one host name, and each its own process 7; the suffix tells them apart. So it does a machine
    before and after it was started again: of two machines of one host name it could not be told.
    """
    parts = []
    with contextlib.suppress(OSError):  # not Linux: the host name must do
        parts.append(Path("/proc/sys/kernel/random/boot_id").read_text())
        parts.append(os.readlink("/proc/self/ns/pid"))
    return f"{socket.gethostname()}.{hashlib.sha256(repr(parts).encode()).hexdigest()[:8]}"


def is_alive(pid: int, *, since_ns: int | None = None) -> bool:
    """Whether a process of this machine runs, and (with ``since_ns``) already ran at that time of the clock.

    A zombie does not run, and a later process with the same number is another one.
    """
    import psutil  # here, as every command that writes a file imports this module

    try:
        process = psutil.Process(pid)
        runs = process.status() not in (psutil.STATUS_ZOMBIE, psutil.STATUS_DEAD)
        return runs and (since_ns is None or process.create_time() * 1e9 < since_ns + _CLOCK_SLACK_NS)
    except psutil.NoSuchProcess:
        return False
