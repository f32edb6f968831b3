"""Keeps what moderators have decided about people, by id: who leaves and comes back is the same person.

A removal and an avatar's taking off are never taken back; of mutes the latest act counts.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import TypeVar

MOST_RULED = 1000
"""People of each kind; beyond it the oldest may do as before, and a moderator had better lock the door."""

_Ruling = TypeVar("_Ruling")


class Rulings:
    """What moderators of one room have decided."""

    def __init__(self) -> None:
        self._removed: dict[str, None] = {}
        self._undressed: dict[str, None] = {}
        self._mutes: dict[str, tuple[int, bool]] = {}

    @property
    def any(self) -> bool:
        """Whether there are any."""
        return bool(self._removed or self._undressed or self._mutes)

    @property
    def removed(self) -> tuple[str, ...]:
        """Ids of those who are kept out."""
        return tuple(self._removed)

    @property
    def undressed(self) -> tuple[str, ...]:
        """Ids of those whose own avatar was taken off: they bring no other."""
        return tuple(self._undressed)

    @property
    def mutes(self) -> Mapping[str, tuple[int, bool]]:
        """How often somebody was muted or given their voice back, and whether they are muted now."""
        return MappingProxyType(self._mutes)

    def is_removed(self, id: str) -> bool:
        """Whether somebody is kept out."""
        return id in self._removed

    def is_undressed(self, id: str) -> bool:
        """Whether somebody brings no avatar any more."""
        return id in self._undressed

    def is_muted(self, id: str) -> bool:
        """Whether somebody is muted."""
        return self._mutes.get(id, (0, False))[1]

    def remove(self, id: str) -> bool:
        """Let somebody in no more; says whether that is new."""
        new = id not in self._removed
        _keep(self._removed, id, None)
        return new

    def undress(self, id: str) -> bool:
        """Let somebody bring no avatar any more; says whether that is new."""
        new = id not in self._undressed
        _keep(self._undressed, id, None)
        return new

    def mute(self, id: str, muted: bool, *, acts: int | None = None) -> bool:
        """Mute somebody, or give their voice back; says whether that is newer than what is known.

        ``acts`` where another process counted.
        """
        known = self._mutes.get(id, (0, False))
        ruling = (known[0] + 1 if acts is None else acts, muted)
        if ruling <= known:
            return False
        _keep(self._mutes, id, ruling)
        return True


def _keep(kept: dict[str, _Ruling], id: str, ruling: _Ruling) -> None:
    kept.pop(id, None)
    kept[id] = ruling
    if len(kept) > MOST_RULED:
        kept.pop(next(iter(kept)))
