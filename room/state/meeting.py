"""Holds one room: who sits in it, what each may do, and the one buffer that goes to all at each tick.

Nothing here waits or sends. Times are seconds of one clock that never goes back, given by the caller.
"""

import hashlib

from room.errors import NotAllowed
from room.protocol import check
from room.protocol.accounts import MOST_RESIDENTS
from room.protocol.answers import Person
from room.protocol.texts import Join, Moderate
from room.protocol.tick import pack
from room.state.names import free_name
from room.state.numbers import free_number
from room.state.rulings import Rulings
from room.state.seat import Seat

KEEP_S = 30.0
"""A place is kept this long for somebody whose connection broke: a laptop's change of networks takes ten."""

MOST_BEYOND = 8
"""Places beside the others, for moderators alone: who fills a room cannot keep out who would empty it."""

ELSEWHERE_S = 5.0
"""Longer wait for somebody of another process: that process says first that their place is free."""


def identity(secret: str) -> str:
    """Public name of whoever has this secret: 64 bits of its hash, from which nobody comes back to the secret."""
    return hashlib.sha256(secret.encode()).hexdigest()[:16]


class Meeting:
    """One room and the people in it.

    Parameters
    ----------
    most_people
        Places, kept ones among them; moderators have `MOST_BEYOND` more.
    process
        Name of the process that this is, where several carry the room (`room.state.accounts`).
    first_number
        Of its people: others begin elsewhere, so that two seldom give one number at one time.

    Attributes
    ----------
    locked
        Whether only those who have a place may come in.
    lock_acts
        How often moderators locked or unlocked.
    sharer
        Id of whoever shows something on the screens; empty where nobody does.
    share_acts
        How often that changed.
    rulings
        What moderators have decided about people, also about those who are not here.
    """

    def __init__(self, *, most_people: int, process: str = "", first_number: int = 0) -> None:
        self.most_people, self.process = most_people, process
        self._first_number = first_number
        self.locked, self.lock_acts = False, 0
        self.sharer, self.share_acts = "", 0
        self._seats: dict[str, Seat] = {}
        self.rulings = Rulings()

    @property
    def people(self) -> tuple[Person, ...]:
        """The roster."""
        return tuple(seat.person for seat in self._seats.values())

    @property
    def seats(self) -> tuple[Seat, ...]:
        """All places."""
        return tuple(self._seats.values())

    @property
    def empty(self) -> bool:
        """Whether nobody of this process has a place any more, but those of a recording."""
        return all(seat.replayed or seat.home != self.process for seat in self._seats.values())

    def seat(self, id: str) -> Seat | None:
        """The place of a person; None where they have none."""
        return self._seats.get(id)

    def numbered(self, number: int) -> Seat | None:
        """The place with a number; None where nobody has it."""
        return next((seat for seat in self._seats.values() if seat.number == number), None)

    def settle(self, seat: Seat | None, number: int, id: str) -> Seat:
        """Give somebody of another process their place: a new one, or ``seat`` with a number that is free."""
        if seat is None:
            muted = self.rulings.is_muted(id)
            seat = Seat(number=number, id=id, name="", avatar="", visit="", moderator=False, muted=muted)
            self._seats[id] = seat
        seat.number, seat.shares = number, id == self.sharer
        return seat

    def enter(self, join: Join, *, moderator: bool) -> Seat:
        """Give somebody who came with a good key their place: a new one, or the one that is kept for them.

        Raises
        ------
        NotAllowed
            If the room is locked or full, they were removed, or a program comes for somebody who is not there.
        """
        id = identity(join.secret)
        seat = self._seats.get(id)
        if self.rulings.is_removed(id):
            raise NotAllowed("a moderator has removed you from this room")
        if join.role == "face":
            if seat is None:
                raise NotAllowed(
                    "nobody with this link is in the room; open the page first, then start the program",
                    again=True,
                )
            return seat
        if seat is None:
            if self.locked and not moderator:
                raise NotAllowed("the room is locked; ask a moderator to open it", again=True)
            self._refuse_full(moderator=moderator)
            seat = Seat(
                number=self._free_number(int(id, 16)),
                id=id,
                name="",
                avatar=join.avatar,
                visit=join.visit,
                moderator=moderator,
                muted=self.rulings.is_muted(id),
            )
            self._seats[id] = seat
        if seat.shares and seat.visit != join.visit:  # the page that showed something is gone
            self.screen("")
        self._name(seat, join.name, moderator=moderator)
        seat.avatar, seat.visit, seat.moderator = join.avatar, join.visit, moderator
        seat.gone_at, seat.voice = None, False
        # another process may have them, and not have told yet: their own clock then says which coming is the later one
        seat.home, seat.entry = self.process, max(seat.entry + 1, join.at_ms)
        return seat

    def _name(self, seat: Seat, wish: str, *, moderator: bool) -> None:
        """Let somebody have a name that no other has, or give those who lose it to them a number behind it.

        Moderators keep theirs, and take one from guests. Guests take one from guests who have gone: these may be
        themselves, of a browser that forgot who they were.
        """
        others = [other for other in self.seats if other is not seat]
        losing = [
            other
            for other in others
            if other.home == self.process  # another process names its own people
            and not (other.moderator or other.replayed)
            and (moderator or other.gone_at is not None)
        ]
        seat.name = free_name(wish, taken=[other.name for other in others if other not in losing])
        if seat.name != wish:  # a number behind it is nobody's wish: none loses theirs to it
            seat.name = free_name(wish, taken=[other.name for other in others])
        for loser in losing:
            loser.name = free_name(loser.name, taken=[each.name for each in self.seats if each is not loser])

    def _refuse_full(self, *, moderator: bool) -> None:
        most = min(self.most_people + MOST_BEYOND, MOST_RESIDENTS) if moderator else self.most_people
        if sum(not other.replayed for other in self._seats.values()) >= most:
            raise NotAllowed(f"the room is full; it has {most} places", again=True)

    def replay(self, *, id: str, name: str, avatar: str, number: int) -> Seat:
        """Give a place to somebody out of a recording, however full the room is; ``number`` is the recorded one."""
        seat = Seat(
            number=self._free_number(number),
            id=f"replay-{id}",  # no `identity` has such a name: nobody can come and be them
            name=name,
            avatar=avatar,
            visit="",
            moderator=False,
            replayed=True,
            home=self.process,
        )
        self._seats[seat.id] = seat
        return seat

    def _free_number(self, wish: int) -> int:
        taken = {seat.number for seat in self._seats.values()}
        return free_number(wish, taken=taken, first=self._first_number)

    def take(self, seat: Seat, message: bytes, *, program: bool, now: float) -> bool:
        """Keep somebody's state for the next tick; says whether another moves their face from now on.

        Raises
        ------
        FormatError
            If the bytes are no message.
        """
        check(message)
        return seat.take(message, program=program, now=now)

    def moderate(self, by: Seat, act: Moderate) -> Seat | None:
        """Do what a moderator asks; gives the person who is otherwise now, or has gone (`seat` knows).

        Raises
        ------
        NotAllowed
            If ``by`` is no moderator, nobody has that number, or somebody else has it now.
        """
        if not by.moderator:
            raise NotAllowed("only a moderator can do this; use the moderator's link")
        if act.action in ("lock", "unlock"):
            self.locked, self.lock_acts = act.action == "lock", self.lock_acts + 1
            return None
        seat = None if act.number is None else self.numbered(act.number)
        if seat is None:
            raise NotAllowed(f"nobody here has number {act.number}")
        if act.id not in ("", seat.id):
            raise NotAllowed(f"they have left, and {seat.name} has their number now; nothing was done")
        if act.action == "unshare":
            if seat.shares:
                self.screen("")
        elif act.action == "remove":
            if seat is by:
                raise NotAllowed("a moderator cannot remove themselves; leave instead")
            self.leave(seat)
            self.rulings.remove(seat.id)
        elif act.action == "undress":
            seat.own = ""
            self.rulings.undress(seat.id)
        else:
            seat.mute(act.action == "mute")
            if seat.muted and seat.shares:  # who may not speak shows nothing either
                self.screen("")
            self.rulings.mute(seat.id, seat.muted)
        return seat

    def share(self, seat: Seat, *, on: bool) -> list[Seat]:
        """Give the screens to somebody, or take what they show away; gives all who are otherwise now.

        Raises
        ------
        NotAllowed
            If another shares already, or a moderator has muted them.
        """
        if not on:
            return self.screen("") if seat.shares else []
        if seat.muted:
            raise NotAllowed("a moderator has muted you; nothing is shared", again=True)
        other = self._seats.get(self.sharer)
        if other and other is not seat:
            raise NotAllowed(f"{other.name} shares already; they or a moderator can end it", again=True)
        return self.screen(seat.id)

    def screen(self, id: str, *, acts: int | None = None) -> list[Seat]:
        """Let whoever has this id share, and nobody else; ``acts`` where another process counted."""
        self.sharer, self.share_acts = id, self.share_acts + 1 if acts is None else acts
        changed = [seat for seat in self._seats.values() if seat.shares != (seat.id == id)]
        for seat in changed:
            seat.shares = not seat.shares
        return changed

    def leave(self, seat: Seat) -> None:
        """Free somebody's place at once."""
        if seat.shares:
            self.screen("")
        self._seats.pop(seat.id, None)

    def expire(self, *, now: float) -> list[Seat]:
        """Free the places of those who did not come back in `KEEP_S`; gives them."""
        late = [
            seat
            for seat in self._seats.values()
            if seat.gone_at is not None
            and now - seat.gone_at > KEEP_S + (0 if seat.home == self.process else ELSEWHERE_S)
        ]
        for seat in late:
            self.leave(seat)
        return late

    def tick(self, *, now: float) -> bytes | None:
        """What came since the last tick, as one buffer for all; None where nobody moved."""
        states = [(seat.number, state) for seat in self._seats.values() for state in seat.taken()]
        return pack(states, time_ms=int(now * 1000)) if states else None

    def whole(self, *, now: float) -> bytes:
        """The last states of all, for somebody who comes late."""
        states = [(seat.number, state) for seat in self._seats.values() if (state := seat.state) is not None]
        return pack(states, time_ms=int(now * 1000))
