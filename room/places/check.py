"""Decides whether others' browsers can be asked to load a place."""

from typing import Any

from facegen.formats.gltf_container import Chunks
from room.gltf import Bounds, check_gltf

MOST_TRIANGLES = 500_000
"""As drawn: the operating room has 60,000; a telephone draws half a million at some frames a second."""

MOST_DRAWN = 1_000
"""Primitives that are drawn one by one; ours have 6 and 9, and each costs a browser some microseconds a picture."""

MOST_NODES = 10_000
"""Of one place; the page goes through all of them once."""

_BOUNDS = Bounds(triangles=MOST_TRIANGLES, parts=MOST_DRAWN, nodes=MOST_NODES, extensions=frozenset())


def check_place(document: dict[str, Any], chunks: Chunks, *, where: str) -> None:
    """Refuse what no page should load; as `room.gltf.check_gltf`."""
    check_gltf(document, chunks, where=where, bounds=_BOUNDS)
