"""Leaves passwords and keys out of words that a person typed, before they are shown or kept: people share both."""

import re

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
