"""CSV files of OpenFace and py-feat: columns ``x_0 .. x_67`` and ``y_0 .. y_67``, read by name.

OpenFace puts a blank before each column's name, all x before all y, ``success`` 0 where it saw no face.
py-feat leaves cells empty there. Columns ``x_68``, ``y_68``, ``x_69``, ``y_69`` are irises, if it has all four. Of
MediaPipe's mesh, ``mesh_x_0 .. mesh_x_477`` or ``x_0 .. x_477``, 68 points and the irises are taken; of OpenFace's
eyes, ``eye_lmk_x_0 .. eye_lmk_x_55``, the middles of the irises' edges.
"""

import math
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT
from facegen.formats.csv_rows import CsvRows, number_in, numbers_in
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames, split_irises, stacked
from regress.runtime.inputs.mesh import VERTICES, irises_of, landmarks_of
from regress.runtime.inputs.people import people_of, places_of

_POINTS = tuple(f"{axis}_{index}" for index in range(LANDMARK_COUNT) for axis in "xy")
_BY_AXIS = tuple(sorted(_POINTS, key=lambda name: name[0]))
_IRISES = tuple(f"{axis}_{index}" for index in (LANDMARK_COUNT, LANDMARK_COUNT + 1) for axis in "xy")
"""Of the subject's right iris, then of the left one, where a table has them."""

_EDGE = 8
"""Points about the edge of an iris, the first of OpenFace's 28 of each eye."""

_EDGES = tuple(f"eye_lmk_{axis}_{eye + index}" for eye in (0, 28) for index in range(_EDGE) for axis in "xy")
"""Of OpenFace's eyes in two dimensions: the one at the picture's left, the subject's right eye, first."""

_MESHES = tuple(
    tuple(f"{prefix}{axis}_{index}" for index in range(VERTICES) for axis in "xy") for prefix in ("mesh_", "")
)
"""MediaPipe's points in py-feat. Where they are called ``mesh_``, its ``x_0 .. x_67`` are some of these too, and not
those of iBUG: the chin is point 10, and point 33 the tip of the nose."""

_SIZE = ("FrameWidth", "FrameHeight")
"""Of the pictures, as py-feat calls it."""

_LARGEST_PX = 99_999
"""Of their sides, as of ``--picture``."""

_TRUST = ("confidence", "FaceScore")
"""How sure OpenFace and py-feat are of a face, 0 to 1."""

_TRUST_LEAST = 0.5
"""Below, a face is none: py-feat's own limit, and what OpenFace calls a success lies above it."""

_LONGER = f"x_{LANDMARK_COUNT + 2}"
"""A column that neither 68 points have nor their irises."""

_PEOPLE = ("face_id", "Identity")
"""Which person a face is, as OpenFace and py-feat call it."""

_OTHERS = ("frame", "timestamp", "success", *_TRUST, *_SIZE, *_PEOPLE)

_LATEST_S = 1e19
"""Of a time: nanoseconds since 1970 are less."""


def is_table(path: Path) -> bool:
    """Whether this is a ``.csv`` file."""
    return path.suffix.lower() == ".csv"


def read_table(path: Path) -> Frames:
    """Frames of an OpenFace or py-feat CSV, told apart by the column ``success``, which OpenFace has.

    In OpenFace's a frame without success has no face, nor has one of which the detector is not sure. Labels are the
    column ``frame``, or count from 0. Several faces of a frame are rows of their own: ``frame/FACE``, by the column
    ``face_id`` or ``Identity`` where it tells the faces of each frame apart, else by who was nearest before.
    """
    with CsvRows(path) as table:
        shown = _shown(table)
        table.check((*shown, *_OTHERS))
        return _frames(table, shown)


def _shown(table: CsvRows) -> tuple[str, ...]:
    """Columns of the points that are read: a mesh's where there is one, else the 68, maybe with irises."""
    columns = table.columns.keys()
    mesh = next((names for names in _MESHES if columns >= set(names)), None)
    if mesh is not None:
        return mesh
    missing = [name for name in _BY_AXIS if name not in columns]
    if missing == list(_BY_AXIS) and set(BLENDSHAPES) <= {name[:1].lower() + name[1:] for name in columns}:
        raise InputError(
            f"{table.path} is a table of weights already; the landmarks that they came from are needed"
        )
    if missing:
        raise InputError(
            f"{table.path} lacks {len(missing)} of the columns x_0 .. x_67, y_0 .. y_67, first {missing[0]}; "
            "OpenFace and py-feat write them"
        )
    if _LONGER in columns:
        raise InputError(
            f"{table.path} has a column {_LONGER}, but not all of x_0 .. x_477, y_0 .. y_477 of MediaPipe's mesh; "
            "these are needed, or 68 points in iBUG's order"
        )
    return _POINTS + next((names for names in (_IRISES, _EDGES) if set(names) <= columns), ())


def _frames(table: CsvRows, shown: tuple[str, ...]) -> Frames:
    columns = table.columns
    openface = "success" in columns
    timed = openface and "timestamp" in columns
    person = next((columns[name] for name in _PEOPLE if name in columns), None)
    said = [name for name in ("success", *_TRUST, *_SIZE) if name in columns]
    names = (*shown, *said, *(["timestamp"] if timed else []))
    picked = [columns[name] for name in names]
    labels: list[str] = []
    people: list[str] = []
    time_s: list[float] = []
    sizes_px: set[tuple[float, ...]] = set()

    def faces() -> Iterator[np.ndarray]:
        for number, row in enumerate(table):
            numbers = _numbers(table, row, names, picked)
            of_row = dict(zip(said, numbers[len(shown) :].tolist(), strict=False))
            labels.append(row[columns["frame"]].strip() if "frame" in columns else str(number))
            people.append("" if person is None else row[person].strip())
            if timed:
                time_s.append(numbers[-1])
            size_px = tuple(of_row.get(name, math.nan) for name in _SIZE)
            if all(1 <= side <= _LARGEST_PX for side in size_px):
                sizes_px.add(size_px)
            points = _landmarks(numbers[: len(shown)].reshape(-1, 2))
            yield points if _is_face(of_row) else np.full_like(points, np.nan)

    points, irises = split_irises(stacked(faces(), table.path))
    if any(abs(time) > _LATEST_S for time in time_s):
        raise InputError(f"{table.path}: a timestamp is beyond {_LATEST_S:g} s")
    numbers = _counted(labels) if "frame" in columns else None
    face_ids = _told_apart(labels, people, np.isfinite(points).all(axis=(1, 2)))
    if face_ids is not None and numbers is not None and (np.diff(numbers) < 0).any():
        # sorted by faces: a film goes from picture to picture
        order = np.argsort(numbers, kind="stable")
        points, numbers = points[order], numbers[order]
        irises = None if irises is None else irises[order]
        labels, face_ids = [labels[row] for row in order], [face_ids[row] for row in order]
        time_s = [time_s[row] for row in order] if timed else time_s
    elif numbers is not None and (np.diff(numbers) < 0).any():
        numbers = None
    several = len(set(labels)) < len(labels)
    if several and face_ids is None:
        face_ids = places_of(labels) if numbers is None else people_of(points, labels)
    names = tuple(labels)
    if several:
        labels = [f"{frame}/{face}" for frame, face in zip(labels, face_ids, strict=True)]
    return Frames(
        points=points,
        labels=tuple(labels),
        time_s=np.array(time_s) if timed else None,
        source=str(table.path),
        irises=irises,
        numbers=numbers,
        faces=tuple(face_ids) if several and numbers is not None else None,
        picture_names=names if several and numbers is not None else None,
        picture_px=tuple(map(round, *sizes_px)) if len(sizes_px) == 1 else None,
    )


def _landmarks(points: np.ndarray) -> np.ndarray:
    """Points (68 or 70, 2) of those of a row, of which a mesh has more, and OpenFace's edges of irises."""
    if len(points) == VERTICES:
        return np.concatenate([landmarks_of(points), irises_of(points)[::-1]])
    if len(points) == LANDMARK_COUNT + 2 * _EDGE:
        face, edges = np.split(points, [LANDMARK_COUNT])
        return np.concatenate([face, edges.reshape(2, _EDGE, 2).mean(axis=1)])
    return points


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
