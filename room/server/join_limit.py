"""Limits how often people come into a room, so that the others do not hear of nothing else."""

import time

from room.errors import NotAllowed
from room.protocol.texts import Join
from room.server.limits import BURST_S, NEWCOMERS_PER_S, RETURNS_PER_S, Bucket
from room.state import Meeting, identity


class JoinLimit:
    """How often people come into one room.

    Parameters
    ----------
    most_people
        Places of the room.
    """

    def __init__(self, most_people: int) -> None:
        self._newcomers = Bucket(NEWCOMERS_PER_S, burst=2 * most_people)
        self._returns: dict[str, Bucket] = {}

    def count(self, join: Join, meeting: Meeting, *, moderator: bool) -> None:
        """Count one: who is known by their own count, so that strangers keep out nobody.

        Raises
        ------
        NotAllowed
            If they come in too often.
        """
        id = identity(join.secret)
        known = meeting.seat(id) is not None
        if moderator or (not known and join.role == "face"):
            return
        bucket = self._newcomers
        if known:
            bucket = self._returns.setdefault(id, Bucket(RETURNS_PER_S, burst=RETURNS_PER_S * BURST_S))
        if not bucket.take(now=time.monotonic()):
            raise NotAllowed("too many come in at once; wait a moment", again=True)

    def forget(self, id: str) -> None:
        """Drop the count of somebody who has left."""
        self._returns.pop(id, None)
