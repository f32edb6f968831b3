"""People's own avatars: what a file may hold that others' browsers are to load, and how long it is kept."""

from room.avatars.check import check_avatar
from room.avatars.store import AvatarStore, digest_of

__all__ = ["AvatarStore", "check_avatar", "digest_of"]
