"""Writes the states of those who agreed to be recorded, a line at a time, each whole on disk before the next.

A thread of its own writes: a disk that stalls would else hold up everybody's ticks.
"""

import os
import queue
import secrets
import threading
import time
from collections.abc import Callable, Iterable
from io import FileIO
from pathlib import Path

from facegen.conventions import BLENDSHAPES
from facegen.errors import OutputError
from facegen.files import output_errors
from room.errors import InputError
from room.protocol.answers import Person
from room.protocol.tick import unpack
from room.recording.lines import MOST_RECORDING_BYTES, Came, Event, Gone, Heading, Tick

MOST_WAITING = 300
"""Lines that wait for the disk, of ten seconds; with more it does not keep up, and the recording ends."""


class Recorder:
    """One room's recording. Keeps nothing of anybody who did not agree, not even that they were there.

    Parameters
    ----------
    path
        Must not be there yet: what people agreed to is never written over.
    room
        Name of the only room that is recorded.
    hertz
        Ticks a second.
    ended
        Called with a sentence where the recording ends before the meeting: no space is left, or it is full. Another
        thread may call it.
    most_bytes
        Of the file.

    Attributes
    ----------
    id
        Of this recording: who agreed to be in another one has not agreed to this.

    Raises
    ------
    InputError
        If the file is there already.
    OutputError
        If it cannot be made.
    """

    def __init__(
        self,
        path: Path,
        *,
        room: str,
        hertz: int,
        ended: Callable[[str], None],
        most_bytes: int = MOST_RECORDING_BYTES,
    ) -> None:
        self.path, self.room, self.id = path, room, secrets.token_hex(8)
        self._ended, self._most_bytes = ended, most_bytes
        self._known: dict[int, Came] = {}
        self._began = time.monotonic()
        try:
            with output_errors(path):
                # for its owner alone: faces of people, if as numbers
                handle = os.open(
                    path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o600
                )
        except OutputError as error:
            if isinstance(error.__cause__, FileExistsError):
                raise taken(path) from None
            raise
        self._lines: queue.Queue[bytes | None] = queue.Queue(MOST_WAITING)
        self._open = True
        file = FileIO(handle, "wb")
        heading = _line(Heading(room=room, began_s=time.time(), hertz=hertz, shapes=BLENDSHAPES))
        self._put(file, heading)
        self._bytes = len(heading)
        self._thread = threading.Thread(target=self._write, args=(file,), name="recorder", daemon=True)
        self._thread.start()

    @property
    def open(self) -> bool:
        """Whether lines are still written."""
        return self._open

    def roster(self, people: Iterable[Person]) -> None:
        """Note who is recorded from now on, and who no longer."""
        now = self._now()
        recorded = {
            person.number: Came(
                time_ms=now, number=person.number, id=person.id, name=person.name, avatar=person.avatar
            )
            for person in people
            if person.recorded
        }
        for number in self._known.keys() - recorded.keys():
            del self._known[number]
            self._take(Gone(time_ms=now, number=number))
        for number, came in recorded.items():
            before = self._known.get(number)
            if before is None or before.model_copy(update={"time_ms": now}) != came:
                self._known[number] = came
                self._take(came)

    def tick(self, content: bytes) -> None:
        """Keep what the room sends to all, of those who are recorded."""
        _, states = unpack(content)
        kept = tuple((number, state) for number, state in states if number in self._known)
        if kept:
            # they were checked when they came in
            self._take(Tick.model_construct(time_ms=self._now(), states=kept))

    def settle(self) -> None:
        """Wait until all that was taken so far is on disk."""
        self._lines.join()

    def close(self) -> None:
        """End the file, with all that was taken."""
        self._open = False
        if self._thread.is_alive():
            self._lines.put(None)
            self._thread.join()

    def _now(self) -> int:
        return int((time.monotonic() - self._began) * 1000)

    def _take(self, event: Event) -> None:
        if not self._open:
            return
        line = _line(event)
        if self._bytes + len(line) > self._most_bytes:
            self._end(f"{self.path}: is full, with {self._most_bytes:,} bytes; the recording has ended")
            return
        self._bytes += len(line)
        try:
            self._lines.put_nowait(line)
        except queue.Full:
            self._end(
                f"{self.path}: the disk does not keep up; the recording has ended, and the meeting goes on"
            )

    def _end(self, text: str) -> None:
        self._open = False
        self._ended(text)

    def _write(self, file: FileIO) -> None:
        """Write what was taken until there is no more; after a failure nothing."""
        failed = False
        while (line := self._lines.get()) is not None:
            try:
                if not failed:
                    self._put(file, line)
            except OutputError as error:
                failed = True
                self._end(f"{error}; the recording has ended, and the meeting goes on")
            finally:
                self._lines.task_done()
        file.close()

    def _put(self, file: FileIO, line: bytes) -> None:
        """Hand a line to the system, which keeps it whatever becomes of this process."""
        left = memoryview(line)
        with output_errors(self.path):
            while left:
                left = left[file.write(left) :]


def taken(path: Path) -> InputError:
    """The refusal of a name behind which something is already."""
    return InputError(f"{path}: is there already; name another file for this recording")


def _line(event: Event | Heading) -> bytes:
    return event.model_dump_json().encode() + b"\n"
