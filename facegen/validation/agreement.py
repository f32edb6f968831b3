"""Compares stored labels with labels made anew."""

from collections.abc import Iterator
from math import isfinite

import numpy as np

from facegen.store import differing_rows

MOST_DIMENSIONS = 4
"""Of a label's numbers; the deepest are matrices."""


def disagreements(stored: object, made: object, name: str = "") -> Iterator[tuple[str, str]]:
    """Name and description of every label of a record that differs from the record made anew.

    Lists are compared as arrays, so that one moved landmark is one disagreement that says which and how far.
    """
    if isinstance(made, dict):
        if not isinstance(stored, dict):
            yield name, f"should be a table, and is {_short(stored)}"
            return
        for key, value in made.items():
            inner = f"{name}.{key}" if name else key
            if key not in stored:
                yield inner, "is missing"
            else:
                yield from disagreements(stored[key], value, inner)
        for key in sorted(stored.keys() - made.keys()):
            yield f"{name}.{key}" if name else key, "is no label of this version of facegen"
    elif isinstance(made, list):
        yield from _list_disagreement(stored, made, name)
    elif not _same(stored, made):
        yield name, f"is {_short(stored)}; the spec gives {_short(made)}"


def _list_disagreement(stored: object, made: list, name: str) -> Iterator[tuple[str, str]]:
    if made and isinstance(made[0], dict | str):
        if not isinstance(stored, list) or len(stored) != len(made):
            yield name, f"should have {len(made)} entries"
            return
        for index, (f, m) in enumerate(zip(stored, made, strict=True)):
            yield from disagreements(f, m, f"{name}[{index}]")
        return
    expected = _numbers(made)
    actual = _numbers(stored)
    if actual is None or actual.shape != expected.shape:
        yield name, f"should be numbers of shape {expected.shape}"
        return
    rows = np.flatnonzero(differing_rows(actual, expected)) if expected.size else []
    if not len(rows):
        return
    first = int(rows[0])
    more = f" (and {len(rows) - 1} more)" if len(rows) > 1 else ""
    if name.endswith("_2d"):
        distance = np.linalg.norm(actual[first] - expected[first])
        yield name, f"point {first} lies {distance:.2f} px from where the spec puts it{more}"
    else:
        is_now, should_be = _short(actual[first].tolist()), _short(expected[first].tolist())
        yield name, f"row {first} is {is_now}; the spec gives {should_be}{more}"


def _numbers(values: object) -> np.ndarray | None:
    """Nested lists as an array; None where they hold anything but numbers and null, or are no grid of them."""
    if not all(map(_is_number, _leaves(values))):
        return None
    try:
        return np.array(values, np.float64)  # None, JSON's stand-in for NaN, becomes NaN
    except (TypeError, ValueError, OverflowError):
        return None


def _leaves(values: object) -> Iterator[object]:
    """What stands in nested lists of at most `MOST_DIMENSIONS` levels."""
    level = [values]
    for _ in range(MOST_DIMENSIONS):
        yield from (value for value in level if not isinstance(value, list))
        level = [inner for value in level if isinstance(value, list) for inner in value]
    yield from level


def _is_number(value: object) -> bool:
    """Whether a value of JSON is null or a number that is written out: NaN and Infinity are no JSON, true is no 1."""
    if isinstance(value, float):
        return isfinite(value)
    return value is None or (type(value) is int and abs(value) < 2**63)


def _same(stored: object, made: object) -> bool:
    if isinstance(made, bool) or not isinstance(made, int | float):
        return type(stored) is type(made) and stored == made
    if stored is None or not _is_number(stored):
        return False
    return not differing_rows(np.array([float(stored)]), np.array([float(made)]))[0]


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
