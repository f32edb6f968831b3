"""Keeps a profile that changes while faces are answered: written by a thread of its own, the newest state alone.

Where another program has written the file meanwhile, as `track calibrate` in a second terminal, only what changed here
goes into it, and nothing that was read beside another neutral face.
"""

import threading
from collections.abc import Callable
from pathlib import Path

from facegen.documents import read_bytes
from track.errors import InputError, OutputError
from track.profile.profile import MOST_BYTES, Profile, read_profile, write_profile

PAUSE_S = 0.5
"""From a change to the file: a slider that is drawn changes a profile thirty times a second, and each file is synced
to the disk, which takes 5 to 500 ms."""

_BESIDE_NEUTRAL = frozenset({"ranges", "rests", "blinks", "gaze", "eyes", "model"})
"""What a session reads beside a neutral face: it says nothing beside another one."""


class ProfileKeeper:
    """Takes profiles without waiting; `close` writes the last one.

    Parameters
    ----------
    path
        Of the file.
    tell
        Told once, from the keeper's thread, where it cannot be written, and where another program has written it.
    known
        The profile as the session found it.
    pause_s
        As `PAUSE_S`.
    """

    def __init__(
        self, path: Path, tell: Callable[[str], None], *, known: Profile, pause_s: float = PAUSE_S
    ) -> None:
        self._path, self._tell, self._pause_s = path, tell, pause_s
        self._newest = self._given = self._stored = known
        self._content, self._others = self._read(), False
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
        if profile is self._given:
            return
        changes = {name: value for name, value in profile if value != getattr(self._given, name)}
        self._look_for_others()
        if self._others and "neutral" not in changes and self._stored.neutral != profile.neutral:
            changes = {name: value for name, value in changes.items() if name not in _BESIDE_NEUTRAL}
        self._given, self._stored = profile, self._stored.model_copy(update=changes)
        if self._content is not None and self._read() is None and "neutral" not in changes:
            self._say_once(f"{self._path} was removed; what is changed now is forgotten at the end")
            return
        try:
            write_profile(self._path, self._stored)
            self._content = self._read()
        except OutputError as error:
            self._say_once(f"{error}; what is changed now is forgotten at the end")

    def _say_once(self, sentence: str) -> None:
        if not self._told:
            self._tell(sentence)
        self._told = True

    def _look_for_others(self) -> None:
        """Go on from what another program has written; of a file that cannot be read any more from what it was."""
        content = self._read()
        if content in (None, self._content):
            return
        try:
            self._stored = read_profile(self._path)
        except InputError:
            return
        if not self._others:
            self._tell(f"{self._path} was changed by another program; what it has changed stays")
        self._others = True

    def _read(self) -> bytes | None:
        try:
            return read_bytes(self._path, most_bytes=MOST_BYTES)
        except InputError:
            return None
