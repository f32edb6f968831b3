"""Says what the names of a place's nodes mean, and what is missing among them.

The page reads the same names (``web/room/scene/layout.ts``), and docs/room-places.md tells whoever makes a place.
"""

from typing import Any

STANDS, SITS, SCREEN, FLOOR, BLOCK = "place", "seat", "screen", "walk", "block"
"""First words of names: where one stands, sits, shares, may walk, may not. A number may follow, after a dot."""


def named(document: dict[str, Any], word: str) -> list[str]:
    """Names of the nodes that begin with a word, sorted as the page takes them."""
    nodes = document.get("nodes", [])
    names = [node.get("name", "") for node in nodes if isinstance(node, dict)]
    return sorted(
        name for name in names if isinstance(name, str) and (name == word or name.startswith(f"{word}."))
    )


def missing(document: dict[str, Any]) -> str:
    """What people will miss in a place, as one sentence; empty where they miss nothing."""
    lacks = []
    if not named(document, STANDS):
        lacks.append("no place.1, so that people stand wherever there is room")
    if not named(document, FLOOR):
        lacks.append("no walk, so that people stay within four metres of its middle")
    if not named(document, SCREEN):
        lacks.append("no screen, so that nothing can be shared")
    return f"it has {'; '.join(lacks)}" if lacks else ""
