"""Leaves passwords and keys out of words that a person typed, before they are shown or kept: people share both."""

import re
from collections.abc import Iterable

_ADDRESS = re.compile(r"://\S+")

_KEY = re.compile(r"#\S{20,}")
"""Behind a link whose scheme was left out; ``#left`` is half of a camera's picture, and no key is as short."""


def without_secrets(words: str) -> str:
    """Words as they may be shown: of an address without user, password and what stands behind ``?`` or ``#``.

    Cameras take passwords behind a question mark, too (``?user=admin&password=...``), and people write signs into
    passwords that should be escaped: where it cannot be told where one ends, nothing is shown.
    """
    scheme, mark, rest = words.partition("://")
    if not mark:
        return _KEY.sub("#…", words)
    place, *query = re.split(r"[?#]", rest, maxsplit=1)
    if query and "@" in query[0]:
        return f"{scheme}://…"
    return f"{scheme}://{place.rpartition('@')[2]}"


def text_without_secrets(text: str, words: Iterable[str]) -> str:
    """A text, such as a library's message, as it may be shown: each address in it as `without_secrets` leaves it.

    Parameters
    ----------
    text
        Of anybody.
    words
        What a person typed: the text may hold one of them, or its address alone. Where a password with a space ends
        in the text only these words tell.
    """
    for word in words:
        for part in _parts(word):
            for told in (part, repr(part)[1:-1]):
                text = text.replace(told, without_secrets(told))
    return _KEY.sub("#…", _ADDRESS.sub(lambda match: without_secrets(match[0]), text))


def _parts(word: str) -> list[str]:
    """Ways to repeat a word that holds an address: whole, from its scheme on, and without options or half behind."""
    address = re.search(r"[A-Za-z][A-Za-z0-9+.-]*://.*", word, re.DOTALL)
    if address is None:
        return []
    ends = [match.start() for match in re.finditer("[,#]", address[0])]
    return [word, address[0], *(address[0][:end] for end in reversed(ends))]
