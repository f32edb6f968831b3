"""CSV files of OpenFace, py-feat and others: columns as ``x_0 .. x_67`` and ``y_0 .. y_67``, read by name.

OpenFace puts a blank before each column's name, all x before all y, ``success`` 0 where it saw no face.
py-feat leaves cells empty there. Which columns are points `regress.runtime.inputs.columns` says, and what they are
`regress.runtime.inputs.orders`; of OpenFace's eyes, ``eye_lmk_x_0 .. eye_lmk_x_55``, the middles of the irises' edges
are taken.
"""

import math
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from facegen.formats.csv_rows import CsvRows, number_in, numbers_in
from regress.errors import InputError
from regress.runtime.inputs.columns import point_columns
from regress.runtime.inputs.frames import Frames, stacked, timed
from regress.runtime.inputs.orders import seventy
from regress.runtime.inputs.people import people_of, places_of
from regress.runtime.inputs.times import time_names

_EDGE = 8
"""Points about the edge of an iris, the first of OpenFace's 28 of each eye."""

_EDGES = tuple(f"eye_lmk_{axis}_{eye + index}" for eye in (0, 28) for index in range(_EDGE) for axis in "xy")
"""Of OpenFace's eyes in two dimensions: the one at the picture's left, the subject's right eye, first."""

_SIZE = ("FrameWidth", "FrameHeight")
"""Of the pictures, as py-feat calls it."""

_LARGEST_PX = 99_999
"""Of their sides, as of ``--picture``."""

_TRUST = ("confidence", "FaceScore")
"""How sure OpenFace and py-feat are of a face, 0 to 1."""

_TRUST_LEAST = 0.5
"""Below, a face is none: py-feat's own limit, and what OpenFace calls a success lies above it."""

_PEOPLE = ("face_id", "Identity")
"""Which person a face is, as OpenFace and py-feat call it."""

_OTHERS = ("frame", "success", *_TRUST, *_SIZE, *_PEOPLE)


def is_table(path: Path) -> bool:
    """Whether this is a ``.csv`` file."""
    return path.suffix.lower() == ".csv"


def read_table(path: Path) -> Frames:
    """Frames of a table; which of OpenFace's columns it has tells what else is known.

    In OpenFace's a frame without success has no face, nor has one of which the detector is not sure. Labels are the
    column ``frame``, or count from 0. Several faces of a frame are rows of their own: ``frame/FACE``, by the column
    ``face_id`` or ``Identity`` where it tells the faces of each frame apart, else by who was nearest before.
    """
    with CsvRows(path) as table:
        shown = _shown(table)
        table.check((*shown, *_OTHERS))
        return _frames(table, shown)


def _shown(table: CsvRows) -> tuple[str, ...]:
    """Columns of the points that are read, and of the edges of irises where 68 points have no others."""
    points = point_columns(table.columns, table.path)
    alone = len(points) == 2 * LANDMARK_COUNT and set(_EDGES) <= table.columns.keys()
    return points + (_EDGES if alone else ())


def _frames(table: CsvRows, shown: tuple[str, ...]) -> Frames:
    columns = table.columns
    told: dict[str, list[float | None]] = {name: [] for name in _time_columns(table)}
    person = next((columns[name] for name in _PEOPLE if name in columns), None)
    said = [name for name in ("success", *_TRUST, *_SIZE) if name in columns]
    names = (*shown, *said)
    picked = [columns[name] for name in names]
    labels: list[str] = []
    people: list[str] = []
    sizes_px: set[tuple[float, ...]] = set()

    def faces() -> Iterator[np.ndarray]:
        for number, row in enumerate(table):
            numbers = _numbers(table, row, names, picked)
            of_row = dict(zip(said, numbers[len(shown) :].tolist(), strict=False))
            labels.append(row[columns["frame"]].strip() if "frame" in columns else str(number))
            people.append("" if person is None else row[person].strip())
            for name, cells in told.items():
                cells.append(_time(table, row, name))
            size_px = tuple(of_row.get(name, math.nan) for name in _SIZE)
            if all(1 <= side <= _LARGEST_PX for side in size_px):
                sizes_px.add(size_px)
            points = _landmarks(numbers[: len(shown)].reshape(-1, 2))
            yield points if _is_face(of_row) else np.full_like(points, np.nan)

    points, irises = stacked(faces(), table.path)
    times = {name: np.array(cells) for name, cells in told.items() if None not in cells}
    numbers = _counted(labels) if "frame" in columns else None
    face_ids = _told_apart(labels, people, np.isfinite(points).all(axis=(1, 2)))
    if face_ids is not None and numbers is not None and (np.diff(numbers) < 0).any():
        # sorted by faces: a film goes from picture to picture
        order = np.argsort(numbers, kind="stable")
        points, numbers = points[order], numbers[order]
        irises = None if irises is None else irises[order]
        labels, face_ids = [labels[row] for row in order], [face_ids[row] for row in order]
        times = {name: numbers_of[order] for name, numbers_of in times.items()}
    elif numbers is not None and (np.diff(numbers) < 0).any():
        numbers = None
    several = len(set(labels)) < len(labels)
    if several and face_ids is None:
        face_ids = places_of(labels) if numbers is None else people_of(points, labels)
    names = tuple(labels)
    if several:
        labels = [f"{frame}/{face}" for frame, face in zip(labels, face_ids, strict=True)]
    frames = Frames(
        points=points,
        labels=tuple(labels),
        time_s=None,
        source=str(table.path),
        irises=irises,
        numbers=numbers,
        faces=tuple(face_ids) if several and numbers is not None else None,
        picture_names=names if several and numbers is not None else None,
        picture_px=tuple(map(round, *sizes_px)) if len(sizes_px) == 1 else None,
    )
    return timed(frames, times, sure=_of_openface(table))


def _landmarks(points: np.ndarray) -> np.ndarray:
    """Points (68 or 70, 2) of those of a row, of which OpenFace has edges of irises: the right iris comes first."""
    if len(points) == LANDMARK_COUNT + 2 * _EDGE:
        face, edges = np.split(points, [LANDMARK_COUNT])
        return np.concatenate([face, edges.reshape(2, _EDGE, 2).mean(axis=1)])
    return seventy(points)


def _of_openface(table: CsvRows) -> bool:
    return {"success", "timestamp"} <= table.columns.keys()


def _time_columns(table: CsvRows) -> tuple[str, ...]:
    """Columns that may be of times; of one that stands twice another goes before."""
    if _of_openface(table):
        names = ("timestamp",)
    else:
        names = time_names(table.columns)
    once = tuple(name for name in names if name not in table.twice)
    if not once:
        table.check(names)
    return once


def _time(table: CsvRows, row: list[str], name: str) -> float | None:
    """Number of a row; None where a column of that name holds something else, as the hour of a clock."""
    if _of_openface(table):
        return float(_numbers(table, row, (name,), [table.columns[name]])[0])
    try:
        return number_in(row[table.columns[name]])
    except ValueError:
        return None


def _is_face(said: Mapping[str, float]) -> bool:
    """Whether a row's numbers by name call it one; a score that is not known, NaN, does not speak against it."""
    return said.get("success", 1.0) != 0 and not any(said.get(name, 1.0) < _TRUST_LEAST for name in _TRUST)


def _told_apart(frames: list[str], people: list[str], seen: np.ndarray) -> list[str] | None:
    """Which person each row is of, where that is known of every face, and two in a frame are two.

    A row without a face, of which it need not be known, is the first person's.
    """
    first = next((person for person in people if person), "")
    known = [person or ("" if face else first) for person, face in zip(people, seen, strict=True)]
    rows = set(zip(frames, known, strict=True))
    return None if "" in known or len(rows) < len(known) else known


def _counted(frames: list[str]) -> np.ndarray | None:
    """The column ``frame`` as numbers, where it counts the pictures of a film."""
    try:
        numbers = np.array([number_in(frame) for frame in frames])
    except ValueError:
        return None
    counts = (np.abs(numbers) < 2**53).all() and (numbers == np.round(numbers)).all()
    return numbers.astype(np.int64) if counts else None


def _numbers(table: CsvRows, row: list[str], names: tuple[str, ...], picked: list[int]) -> np.ndarray:
    """Numbers of a row under these names, which stand in the columns ``picked``."""
    try:
        return numbers_in(row, picked)
    except ValueError as error:
        name = next(name for name, column in zip(names, picked, strict=True) if not _is_number(row[column]))
        raise InputError(
            f"{table.path}: column {name} holds something that is not a number ({error})"
        ) from error


def _is_number(cell: str) -> bool:
    try:
        number_in(cell)
    except ValueError:
        return False
    return True
