"""Which columns of a table are a face's points: an axis letter and a number, however they are put together.

``x_0``, ``x0``, ``0_x``, ``landmark_0_x`` and ``mesh_x_0`` are of one kind; numbers go on from 0 or from 1.
"""

import re
from collections.abc import Iterable
from pathlib import Path

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.orders import COUNTS, COUNTS_SAID
from regress.runtime.inputs.weights import are_weights

_PIECES = re.compile(r"[0-9]{1,6}|[A-Za-z]+|[^0-9A-Za-z]+")

_AXES = ("x", "y", "X", "Y")

_IN_SPACE = re.compile(r"[XYZ]_[0-9]+")
"""OpenFace's points in millimetres, beside those in the picture."""

_Family = dict[tuple[str, int], str]
"""Names of columns by axis and number."""


def point_columns(columns: Iterable[str], path: Path) -> tuple[str, ...]:
    """Names of the columns x, y, x, y ... of as many points as are known; of several kinds those with most points.

    py-feat's ``x_0 .. x_67`` beside ``mesh_x_0 ..`` are some of the mesh, and not those of iBUG: the chin is point 10.

    Raises
    ------
    InputError
        Where there are none; ``path`` begins the sentence.
    """
    columns = list(columns)
    families = _families(columns)
    runs = {kind: names for kind, family in families.items() if (names := _run(family))}
    if runs:
        return runs[max(runs, key=lambda kind: (len(runs[kind]), "@" in kind))]
    if are_weights(columns):
        raise InputError(
            f"{path} is a table of weights already; the landmarks that they came from are needed"
        )
    most = max((_shared(family) for family in families.values()), key=len, default=[])
    if len(most) <= LANDMARK_COUNT:
        plain = families.get("@_#", {})
        missing = [
            f"{axis}_{index}"
            for axis in "xy"
            for index in range(LANDMARK_COUNT)
            if (axis, index) not in plain
        ]
        raise InputError(
            f"{path} lacks {len(missing)} of the columns x_0 .. x_67, y_0 .. y_67, first {missing[0]}; "
            "OpenFace and py-feat write them, and names such as x0, 0_x or landmark_0_x are read as well"
        )
    raise InputError(f"{path} has columns of {len(most)} points; {COUNTS_SAID} can be read")


def _families(columns: Iterable[str]) -> dict[str, _Family]:
    """Columns of points by what their names have in common: ``#`` is the number, ``@`` the axis, ``^`` a capital."""
    families: dict[str, _Family] = {}
    for name in columns:
        pieces = _PIECES.findall(name)
        axes = [place for place, piece in enumerate(pieces) if piece in _AXES]
        numbers = [place for place, piece in enumerate(pieces) if piece.isdecimal()]
        if len(axes) != 1 or not numbers or _IN_SPACE.fullmatch(name):
            continue
        axis, number = axes[0], min(numbers, key=lambda place: (abs(place - axes[0]), -place))
        marked = [*pieces]
        marked[axis], marked[number] = "@" if pieces[axis].islower() else "^", "#"
        families.setdefault("".join(marked), {})[pieces[axis].lower(), int(pieces[number])] = name
    return families


def _shared(family: _Family) -> list[int]:
    """Numbers of which there are both axes, in their order."""
    return sorted(index for axis, index in family if axis == "x" and ("y", index) in family)


def _run(family: _Family) -> tuple[str, ...]:
    """Columns of points that go on from 0 or 1 and are as many as some order has; none, where they are not.

    68 points with one more are 68: irises are read where there are both.
    """
    indices = _shared(family)
    if not indices or indices[0] > 1:
        return ()
    run = [index for place, index in enumerate(indices) if index == indices[0] + place]
    count = LANDMARK_COUNT if len(run) == LANDMARK_COUNT + 1 else len(run)
    return tuple(family[axis, index] for index in run[:count] for axis in "xy") if count in COUNTS else ()
