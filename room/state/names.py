"""Gives people names that nobody else here has, as far as letters tell: a second one of a name gets a number."""

import itertools
import unicodedata
from collections.abc import Iterable

from room.protocol.texts import MOST_NAME_CHARACTERS


def free_name(wish: str, *, taken: Iterable[str]) -> str:
    """A name as somebody wishes it, with a number behind it while others have it in whatever form or case."""
    others = {_folded(name) for name in taken}
    names = (_numbered(wish, number) if number > 1 else wish for number in itertools.count(1))
    return next(name for name in names if _folded(name) not in others)


def _numbered(wish: str, number: int) -> str:
    return f"{wish[: MOST_NAME_CHARACTERS - len(str(number)) - 1].rstrip()} {number}"


def _folded(name: str) -> str:
    return " ".join(unicodedata.normalize("NFKC", name).casefold().split())
