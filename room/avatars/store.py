"""Keeps people's own avatars in memory, by their content, for as long as somebody in a room wears them."""

import hashlib
from dataclasses import dataclass, field

from room.errors import NotAllowed

MOST_KEPT_BYTES = 512 * 1024**2
"""Of all own avatars of one server together: 16 of the largest, or some fifty of usual ones.

Where several rooms keep some, none takes more than it leaves to all others. A room alone has `ALONE` of them."""

ALONE = 3 / 4
"""Of all bytes for the only room that keeps any: a server with one room has 38 people in avatars of 10 MiB, and a
second room finds a place."""

Wearer = tuple[str, str]
"""A room's name and a person's id."""


def digest_of(content: bytes) -> str:
    """What an avatar is called: the SHA-256 of its bytes."""
    return hashlib.sha256(content).hexdigest()


@dataclass
class _Kept:
    content: bytes
    wearers: set[Wearer] = field(default_factory=set)


class AvatarStore:
    """Avatars that were checked, each once however many wear it.

    Parameters
    ----------
    most_bytes
        Of all together.
    """

    def __init__(self, *, most_bytes: int = MOST_KEPT_BYTES) -> None:
        self._most_bytes = most_bytes
        self._kept: dict[str, _Kept] = {}

    @property
    def kept_bytes(self) -> int:
        """Held now."""
        return sum(len(kept.content) for kept in self._kept.values())

    def put(self, content: bytes, wearer: Wearer) -> str:
        """Let somebody wear an avatar, in place of any other of theirs; gives its digest.

        Raises
        ------
        NotAllowed
            If there is no room for it, or their room has its share; they go on to wear what they wore.
        """
        digest = digest_of(content)
        if digest not in self._kept:
            self._refuse_full(len(content), wearer)
        self.drop(wearer, but=digest)
        self._kept.setdefault(digest, _Kept(content)).wearers.add(wearer)
        return digest

    def fits(self, size: int, wearer: Wearer) -> bool:
        """Whether an avatar of so many bytes that is not kept yet would be taken."""
        try:
            self._refuse_full(size, wearer)
        except NotAllowed:
            return False
        return True

    def _refuse_full(self, more: int, wearer: Wearer) -> None:
        """Refuse so many bytes more in place of what somebody wears alone; no more than that is always taken."""
        room = wearer[0]
        freed = sum(len(kept.content) for kept in self._kept.values() if kept.wearers == {wearer})
        if more <= freed:
            return
        mine = self._bytes_of(room) - freed + more
        kept = self.kept_bytes - freed + more
        if kept > self._most_bytes:
            raise NotAllowed(
                "this server keeps as many own avatars as it can; bring a smaller one, or this one later"
            )
        alone = all(place == room for kept in self._kept.values() for place, _ in kept.wearers)
        if mine > (self._most_bytes * ALONE if alone else self._most_bytes - kept):
            raise NotAllowed(
                "this room has its share of the own avatars that this server keeps; bring a smaller one, or this one "
                "later"
            )

    def _bytes_of(self, room: str) -> int:
        return sum(
            len(kept.content)
            for kept in self._kept.values()
            if any(place == room for place, _ in kept.wearers)
        )

    def get(self, digest: str, room: str) -> bytes | None:
        """An avatar that somebody wears in this room; None where nobody does."""
        kept = self._kept.get(digest)
        worn = kept is not None and any(place == room for place, _ in kept.wearers)
        return kept.content if kept and worn else None

    def settle(self, room: str, worn: dict[str, str]) -> None:
        """Forget what nobody of a room wears any more; ``worn`` has the digest that each person does, by id."""
        for digest, kept in list(self._kept.items()):
            for place, id in list(kept.wearers):
                if place == room and worn.get(id) != digest:
                    self.drop((room, id))

    def drop(self, wearer: Wearer, *, but: str = "") -> None:
        """Forget what somebody wears, ``but`` one digest, and its bytes if nobody else does."""
        for digest, kept in list(self._kept.items()):
            if digest == but:
                continue
            kept.wearers.discard(wearer)
            if not kept.wearers:
                del self._kept[digest]
