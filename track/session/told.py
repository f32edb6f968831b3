"""Says what a person should know, and keeps the newest of it for who looks at the page and not at the terminal."""

import threading
from collections.abc import Callable

_KEPT = 3
"""Sentences: as many are said at once at most, as a recording ends and the next one begins."""


class Told:
    """Says sentences, from any thread.

    Parameters
    ----------
    say
        Takes each of them.

    Attributes
    ----------
    newest
        The last few with their numbers, which rise.
    """

    def __init__(self, say: Callable[[str], None]) -> None:
        self._say, self._lock, self._count = say, threading.Lock(), 0
        self.newest: tuple[tuple[int, str], ...] = ()

    def __call__(self, sentence: str) -> None:
        """Say one."""
        self._say(sentence)
        with self._lock:
            self._count += 1
            self.newest = (*self.newest, (self._count, sentence))[-_KEPT:]
