"""Keeps who of one room agreed to be recorded, and gives their states to the recorder."""

from room.errors import NotAllowed
from room.protocol.answers import Changed, Notice
from room.recording import Recorder
from room.state import Meeting, Seat


class Consents:
    """What people said of being recorded.

    Parameters
    ----------
    meeting
        Who is in the room.
    recorder
        Takes the states of those who agreed; None where nobody is recorded.
    """

    def __init__(self, meeting: Meeting, recorder: Recorder | None) -> None:
        self._meeting, self._recorder = meeting, recorder

    @property
    def recording(self) -> str:
        """Id of the recording that is made now; empty where there is none."""
        return self._recorder.id if self._recorder else ""

    def enter(self, seat: Seat, *, recorded: bool, recording: str) -> None:
        """Take what somebody who comes in said of a recording: of another one it means nothing."""
        seat.recorded = recorded and recording == self.recording != ""
        self.follow()

    def change(self, seat: Seat, *, recorded: bool) -> bool:
        """Take what somebody who is in says; says whether they said otherwise before.

        Raises
        ------
        NotAllowed
            If the room is not recorded.
        """
        if not self.recording:
            raise NotAllowed("this room is not recorded")
        changes, seat.recorded = seat.recorded != recorded, recorded
        self.follow()
        return changes

    def follow(self) -> None:
        """Let the recording know who is there, as somebody has come or gone."""
        if self._recorder:
            self._recorder.roster(self._meeting.people)

    def tick(self, content: bytes | None) -> list[Notice | Changed]:
        """Record a tick; where the recording has ended by itself, gives what all are to be told."""
        if self._recorder is None:
            return []
        if content:
            self._recorder.tick(content)
        return [] if self._recorder.open else self._end()

    def _end(self) -> list[Notice | Changed]:
        self._recorder = None
        told: list[Notice | Changed] = [
            Notice(text="the recording has ended, and nobody is recorded any more", about="consent")
        ]
        for seat in self._meeting.seats:
            if seat.recorded:
                seat.recorded = False
                told.append(Changed(person=seat.person))
        return told
