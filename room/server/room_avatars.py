"""Keeps the own avatars of one room: who wears which, and which of them other processes of the room are sent."""

from room.avatars import AvatarStore
from room.protocol.accounts import Wanted
from room.server.avatar_transfer import AvatarTransfer
from room.server.limits import Bucket
from room.state import Meeting, Seat


class RoomAvatars:
    """Own avatars of the people of one room.

    Parameters
    ----------
    room
        Its name.
    meeting
        Who is in it.
    store
        Keeps the files, of all rooms.
    transfer
        Brings them from other processes, and to them; None where there is one process alone.

    Attributes
    ----------
    uploads
        How often each person has brought one, by id.
    """

    def __init__(
        self, room: str, meeting: Meeting, store: AvatarStore, transfer: AvatarTransfer | None
    ) -> None:
        self._room, self._meeting, self._store, self._transfer = room, meeting, store, transfer
        self.uploads: dict[str, Bucket] = {}

    def put_on(self, seat: Seat, content: bytes) -> None:
        """Let somebody wear an avatar that was checked.

        Raises
        ------
        NotAllowed
            If the server has no room for it; they go on to wear what they wore.
        """
        seat.own = self._store.put(content, (self._room, seat.id))

    def take_off(self, seat: Seat) -> None:
        """Let somebody wear the stand-in."""
        seat.own = ""
        self.drop(seat.id)

    def drop(self, id: str) -> None:
        """Let go of what somebody wore here who is at another process now."""
        self._store.drop((self._room, id))

    def has(self, seat: Seat) -> bool:
        """Whether what somebody wears is at this process."""
        return self._store.get(seat.own, self._room) is not None

    async def transferred(self, digest: str) -> bytes | None:
        """An own avatar that another process of this room took and that fits here; it was not checked here."""
        wearer = next(
            (seat for seat in self._meeting.seats if seat.own == digest and self._is_away(seat)), None
        )
        if self._transfer is None or wearer is None:
            return None
        id = wearer.id
        return await self._transfer.fetch(
            self._room, digest, lambda size: self._store.fits(size, (self._room, id))
        )

    def keep(self, digest: str, content: bytes) -> None:
        """Keep an avatar of another process that was checked, for as long as its people wear it.

        Raises
        ------
        NotAllowed
            If the server has no room for it.
        """
        for seat in self._meeting.seats:
            if seat.own == digest and self._is_away(seat):
                self._store.put(content, (self._room, seat.id))

    def send(self, wanted: Wanted) -> None:
        """Send another process a piece of an avatar that somebody of this one wears."""
        mine = any(seat.own == wanted.digest and not self._is_away(seat) for seat in self._meeting.seats)
        if self._transfer and mine:
            self._transfer.send(self._room, wanted)

    def settle(self) -> None:
        """Let go of what nobody in the room wears any more."""
        self._store.settle(self._room, {seat.id: seat.own for seat in self._meeting.seats})

    def close(self) -> None:
        """Let go of all of it."""
        self._store.settle(self._room, {})

    def _is_away(self, seat: Seat) -> bool:
        return seat.home != self._meeting.process
