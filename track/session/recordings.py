"""Begins and ends the recordings that the page asks for, and ends those that cannot be written: all else goes on."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from facegen.errors import FacegenError
from track.errors import OutputError
from track.sinks.sink import Sink


class Recordings:
    """One recording after the other; one that cannot be written takes nothing else along.

    Parameters
    ----------
    sinks
        Of the session: a recording is among them while it lasts.
    new_recording
        Opens one; None where none can be made.
    say
        Told what a person should know, a sentence each.

    Attributes
    ----------
    lost
        Why the first sink that was asked for from the beginning takes nothing any more; None where all do.
    """

    def __init__(
        self,
        sinks: list[Sink],
        new_recording: Callable[[], Sink] | None,
        say: Callable[[str], None],
    ) -> None:
        self._sinks, self._new_recording, self._say = sinks, new_recording, say
        self._recording: Sink | None = None
        self.lost: OutputError | None = None
        self._finishing = ThreadPoolExecutor(max_workers=1, thread_name_prefix="recording")

    @property
    def under_way(self) -> bool:
        """Whether one is recorded now."""
        return self._recording is not None

    def record(self, wanted: bool) -> None:
        """Begin or end one."""
        try:
            if wanted and self._recording is None and self._new_recording is not None:
                self._recording = self._new_recording()
                self._sinks.append(self._recording)
                self._say(f"recording {self._recording.title}")
            elif not wanted and self._recording is not None:
                recording, self._recording = self._recording, None
                self._sinks.remove(recording)
                self._finishing.submit(self._finish, recording)
        except OutputError as error:
            self._say(str(error))

    def give_up(self, sink: Sink, error: OutputError) -> None:
        """End a recording to which no more can be written; what it has is kept, and all others go on."""
        own = sink is self._recording
        if own:
            self._recording = None
        else:
            self.lost = self.lost or error
        self._sinks.remove(sink)
        self._say(f"{sink.title} ends here, and the rest goes on: {error}")
        self._finishing.submit(self._finish, sink, told=str(error), own=own)

    def close(self) -> None:
        """Wait until what has ended is written."""
        self._finishing.shutdown()

    def _finish(self, recording: Sink, *, told: str = "", own: bool = True) -> None:
        """Give a recording its name, in another thread: a disk takes a frame's time and more.

        ``told`` is the fault that is known already; of others than the page's ``own`` the command says that they are
        there.
        """
        try:
            recording.close()
            if own and recording.kept:
                self._say(f"recorded {recording.title}")
        except FacegenError as error:
            if str(error) != told:
                self._say(str(error))
