"""Keeps a profile that changes while faces are answered: written by a thread of its own, the newest state alone."""

import threading
from collections.abc import Callable
from pathlib import Path

from track.errors import OutputError
from track.profile.profile import Profile, write_profile

PAUSE_S = 0.5
"""From a change to the file: a slider that is drawn changes a profile thirty times a second, and each file is synced
to the disk, which takes 5 to 500 ms."""


class ProfileKeeper:
    """Takes profiles without waiting; `close` writes the last one.

    Parameters
    ----------
    path
        Of the file.
    tell
        Told once, from the keeper's thread, where it cannot be written.
    pause_s
        As `PAUSE_S`.
    """

    def __init__(self, path: Path, tell: Callable[[str], None], *, pause_s: float = PAUSE_S) -> None:
        self._path, self._tell, self._pause_s = path, tell, pause_s
        self._newest: Profile | None = None
        self._written: Profile | None = None
        self._told = False
        self._changed, self._over = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, name="profile", daemon=True)
        self._thread.start()

    def keep(self, profile: Profile) -> None:
        """Take a profile that has changed; returns at once."""
        self._newest = profile
        self._changed.set()

    def close(self) -> None:
        """Write what is not written yet; the thread has ended when this returns."""
        self._over.set()
        self._changed.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._over.is_set():
            self._changed.wait()
            self._over.wait(self._pause_s)
            self._changed.clear()
            self._write()
        self._write()  # what changed while the last file was written

    def _write(self) -> None:
        profile = self._newest
        if profile is self._written:
            return
        self._written = profile
        try:
            write_profile(self._path, profile)
        except OutputError as error:
            if not self._told:
                self._tell(f"{error}; what is changed now is forgotten at the end")
            self._told = True
