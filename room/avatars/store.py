"""Keeps people's own avatars in memory, by their content, for as long as somebody in a room wears them."""

import hashlib
from dataclasses import dataclass, field

from room.errors import NotAllowed

MOST_KEPT_BYTES = 512 * 1024**2
"""Of all own avatars of one server together: 16 of the largest, or some fifty of usual ones.

No room takes more than it leaves to all others: one alone has half, and a second one half of what is left."""

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
            If there is no room for it, or their room has its share; they wear none then.
        """
        self.drop(wearer)
        digest = digest_of(content)
        if digest not in self._kept:
            left = self._most_bytes - self.kept_bytes - len(content)
            if left < 0:
                raise NotAllowed(
                    "this server keeps as many own avatars as it can; try again later", again=True
                )
            if self._bytes_of(wearer[0]) + len(content) > left:
                raise NotAllowed(
                    "this room has its share of the own avatars that this server keeps; bring a smaller one, or "
                    "try again later",
                    again=True,
                )
            self._kept[digest] = _Kept(content)
        self._kept[digest].wearers.add(wearer)
        return digest

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

    def drop(self, wearer: Wearer) -> None:
        """Forget what somebody wears, and its bytes if nobody else does."""
        for digest, kept in list(self._kept.items()):
            kept.wearers.discard(wearer)
            if not kept.wearers:
                del self._kept[digest]
