"""Keeps what moderators of a room have decided for hours after the last person has gone: a break ends no removal."""

from dataclasses import dataclass

from room.state.meeting import Meeting
from room.state.rulings import Rulings

KEPT_S = 12 * 3600.0
"""After the room was empty; then it begins anew, as after a restart of the server."""

MOST_KEPT = 1000
"""Rooms; beyond it the one that has been empty for longest begins anew."""


@dataclass(frozen=True, kw_only=True)
class _Kept:
    rulings: Rulings
    locked: bool
    lock_acts: int
    at: float


class KeptRulings:
    """The rulings of rooms in which nobody is."""

    def __init__(self) -> None:
        self._kept: dict[str, _Kept] = {}

    def keep(self, name: str, meeting: Meeting, *, now: float) -> None:
        """Take the rulings of a room that ends; ``now`` in seconds."""
        self._kept.pop(name, None)
        for late in [name for name, kept in self._kept.items() if now - kept.at > KEPT_S]:
            del self._kept[late]
        if meeting.lock_acts or meeting.rulings.any:
            self._kept[name] = _Kept(
                rulings=meeting.rulings, locked=meeting.locked, lock_acts=meeting.lock_acts, at=now
            )
            if len(self._kept) > MOST_KEPT:
                del self._kept[next(iter(self._kept))]

    def restore(self, name: str, meeting: Meeting, *, now: float) -> None:
        """Let them hold in the room that begins under the same name."""
        kept = self._kept.get(name)
        if kept and now - kept.at <= KEPT_S:
            meeting.rulings, meeting.locked, meeting.lock_acts = kept.rulings, kept.locked, kept.lock_acts
