"""Starts child processes that a stop from outside does not reach before they have decided about it.

Ctrl-C reaches the whole group of processes, and `scancel` every one of a job. A child spends its first second with
imports, in which Python answers with a traceback; so it is born with these signals blocked.
"""

import contextlib
import signal
from collections.abc import Callable, Iterator
from types import FrameType

STOPS = (signal.SIGINT, signal.SIGTERM)
"""Requests to stop."""


@contextlib.contextmanager
def block_stop_signals() -> Iterator[None]:
    """Let children that are started in this block hear no stop, until they call `ignore_stops`.

    This process hears at the end of the block what came in it.
    """
    if not hasattr(signal, "pthread_sigmask"):  # Windows, where Ctrl-C comes as an event
        yield
        return
    # a program that starts no children does not wait for it: meanwhile nobody would answer a stop
    from multiprocessing import resource_tracker

    # its own start unblocks the signals, so it may not be the first thing that a child's start needs
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, STOPS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def answer_stops(answer: Callable[[int, FrameType | None], object] | signal.Handlers) -> None:
    """Answer every stop from now on by this handler."""
    for number in STOPS:
        signal.signal(number, answer)


def ignore_stops() -> None:
    """Leave stops to the parent, which decides and kills; what came since the start of this process is forgotten."""
    answer_stops(signal.SIG_IGN)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, STOPS)
