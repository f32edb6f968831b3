"""Says how much of everything a server takes, and counts it by the second."""

from dataclasses import dataclass

MOST_PEOPLE = 64
"""Places of a room, unless ``--people`` says otherwise: each person then gets 1.3 Mbit/s when all move."""

MOST_ROOMS = 100
"""Rooms with people in them at one time, unless ``--rooms`` says otherwise."""

MOST_CONNECTIONS = 10_000
"""Connections of a process, where the system gives it files for so many: the bound on them is raised at the start."""

MOST_PENDING = 256
"""Connections that have not said yet who they are; each ends after five seconds, the oldest gives way to a new one."""

MOST_BODIES = 1024
"""Files on their way at one time; each takes at most 256 KiB of memory, as the next piece waits for who reads."""

STATES_PER_S = 60
"""States of one connection: twice what a page sends, as timers of browsers make up for late ones."""

TEXTS_PER_S = 20
"""Texts of one connection, but for its calls."""

SIGNALS_A_PERSON = 24
"""Texts by which one calls or answers one of the others, for whom a connection may say them all at once. Calling six
people is a burst of 70, of a description and candidates, so this is twice as many: computers have several networks."""

BURST_S = 10
"""A connection may use this much of its rate at once: after a break, or to call everybody."""

CHATS_PER_S = 1
"""Lines of chat of one connection, with a burst of ten."""

NEWCOMERS_PER_S = 10
"""New people of one room, with a burst of twice its places: each is told to all. Moderators are not counted."""

RETURNS_PER_S = 1
"""Times that one person comes in again, with a burst of ten: a network that comes and goes, a page loaded anew."""

PLAYS_PER_S = 5
"""What those who look at a replay ask of it, with a burst of ten: a jump reads two seconds of the recording."""

MOST_UPLOADS = 8
"""Own avatars that come in at one time: each is held whole in memory until it was checked."""

MOST_UPLOADS_A_ROOM = 4
"""Of them of one room, so that its people, who may be slow on purpose, keep no other room from theirs."""

UPLOADS_PER_S = 1 / 30
UPLOADS_BURST = 4
"""Own avatars of one person, and how many at once: who tries several, or loads the page again."""

MOST_QUEUED_BYTES = 4 * 1024**2
"""Texts that wait for a slow connection before it is closed: it has not read for the time of a whole meeting's talk."""

MOST_FROM_ONE_BYTES = 256 * 1024
"""Of them what one other person's browser says; more of it is dropped. A call has 3 kB, and 24 addresses of 0.3 kB."""

MOST_UNSENT_BYTES = 16 * 1024
"""Written, and not yet taken by the network: more makes ticks old on the way, where no newer one can replace them. The
system's own buffer is held as small, which else grows to 4 MB: half a minute of a slow link."""

MOST_TICKS_QUEUED = 32
"""Ticks that wait for a slow connection, a second's; older ones are dropped, as newer ones say more."""


@dataclass(frozen=True, kw_only=True)
class Limits:
    """What the operator allows.

    Parameters
    ----------
    people
        Places of each room.
    rooms
        With people in them at one time.
    """

    people: int = MOST_PEOPLE
    rooms: int = MOST_ROOMS


class Bucket:
    """Allows a number of things a second, and a burst of them.

    Parameters
    ----------
    per_s
        Allowed on average.
    burst
        Allowed at once.
    """

    def __init__(self, per_s: float, *, burst: float) -> None:
        self._per_s, self._burst = per_s, burst
        self._left, self._at = burst, float("-inf")

    def take(self, *, now: float) -> bool:
        """Count one; says whether it is allowed. ``now`` in seconds."""
        self._left = min(self._burst, self._left + (now - self._at) * self._per_s)
        self._at = now
        if self._left < 1:
            return False
        self._left -= 1
        return True
