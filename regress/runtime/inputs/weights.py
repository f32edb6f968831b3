"""Tells files of weights, which apps and landmarkers write too, from those of points."""

from collections.abc import Iterable

from facegen.conventions import BLENDSHAPES

_SHAPES = frozenset(name.lower() for name in BLENDSHAPES)

_FEW = 20
"""Names of ARKit's shapes from which on something is of weights: MediaPipe's own lack a tongue."""

_DEEPEST, _LOOKED_AT = 6, 100
"""Of JSON: tables and lists in one another, and how many members of each are looked into."""


def are_weights(names: Iterable[object]) -> bool:
    """Whether many of these names are of ARKit's shapes, with or without capitals and lines between their words."""
    called = {name.lower().replace("_", "") for name in names if isinstance(name, str)}
    return len(_SHAPES & called) >= _FEW


def holds_weights(node: object, depth: int = 0) -> bool:
    """Whether parsed JSON has a table of weights, their names in a list, or MediaPipe's list of categories."""
    if depth > _DEEPEST or not isinstance(node, dict | list):
        return False
    members = list(node.values() if isinstance(node, dict) else node)
    named = [
        name
        for member in members[:_LOOKED_AT]
        if isinstance(member, dict)
        for name in (member.get("categoryName"), member.get("category_name"), member.get("name"))
    ]
    if are_weights(node) or are_weights(named):
        return True
    return any(holds_weights(member, depth + 1) for member in members[:_LOOKED_AT])
