"""Faces of MediaPipe's landmarkers in JSON, as programs in Python and JavaScript write its results down.

A picture's result has lists of points ``{x, y, z}``, one for each face, under ``faceLandmarks``, ``face_landmarks`` and
other names; a film is a list of results, or of such lists alone. Points are shares of a picture's width and height.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from regress.errors import InputError
from regress.runtime.inputs.frames import Frames, of_pictures, stacked, timed
from regress.runtime.inputs.orders import COUNTS, COUNTS_SAID, seventy
from regress.runtime.inputs.times import LATEST_S, time_names

_FACES = (
    "faceLandmarks",
    "face_landmarks",
    "multiFaceLandmarks",
    "multi_face_landmarks",
    "landmarks",
    "landmark",  # of one face, as protocol buffers call it
    "keypoints",  # of one face, as TensorFlow.js calls it
)

_FILMS = ("frames", "results", "data")
"""Keys of a list of results."""

_DEEPEST = 8
"""Lists in lists that are looked into."""


def is_document(document: object) -> bool:
    """Whether parsed JSON has a face of such points, or a list of results of which one has."""
    return next(_faces_in(document), None) is not None


def read_parsed(document: Any, path: Path) -> Frames:
    """Frames of what `is_document` has accepted; pictures without a face take their time.

    Raises
    ------
    InputError
        Where a face has another number of points, or something is no number.
    """
    pictures = _pictures(document)
    faces, of, labels = [], [], []
    for number, picture in enumerate(pictures):
        found = [_points(face, path, number) for face in _faces_in(picture)]
        for place, face in enumerate(found, start=1):
            faces.append(face)
            of.append(number)
            labels.append(str(number) if len(found) == 1 else f"{number}/{place}")
    points, irises = stacked(faces, path)
    frames = Frames(
        points=points,
        labels=tuple(labels),
        time_s=None,
        source=str(path),
        irises=irises,
    )
    return timed(of_pictures(frames, of, list(map(str, of))), _times([pictures[number] for number in of]))


def _pictures(document: Any) -> list[Any]:
    if isinstance(document, dict):
        lists = (document[key] for key in _FILMS if isinstance(document.get(key), list))
        film = next((each for each in lists if is_document(each)), None)
        return [document] if film is None else film
    return [document] if _is_face(document) else document


def _faces_in(node: Any, depth: int = 0) -> Iterator[list[Any]]:
    """Lists of points, wherever they stand below what a picture's result may be."""
    if depth > _DEEPEST:
        return
    if _is_face(node):
        yield node
    elif isinstance(node, list):
        for each in node:
            if isinstance(each, list | dict):  # a COCO file's numbers are many
                yield from _faces_in(each, depth + 1)
    elif isinstance(node, dict):
        for key in (*_FACES, *_FILMS):
            if not isinstance(node.get(key), list):
                continue
            faces = _faces_in(node[key], depth + 1)
            first = next(faces, None)
            if first is not None:
                yield first
                yield from faces
            if first is not None or not node[key]:
                return  # an empty list says that there is no face; names of points say nothing


def _is_face(node: Any) -> bool:
    """Whether this is a list of points: tables of x and y, or as many lists of two or three numbers as a face has."""
    if not isinstance(node, list) or not node:
        return False
    first = node[0]
    if isinstance(first, dict):
        return "x" in first and "y" in first
    return (
        isinstance(first, list)
        and len(first) in (2, 3)
        and len(node) in COUNTS
        and all(isinstance(number, int | float) for number in first)
    )


def _points(face: list[Any], path: Path, picture: int) -> np.ndarray:
    try:
        points = np.array(
            [(each["x"], each["y"]) if isinstance(each, dict) else (each[0], each[1]) for each in face],
            dtype=np.float64,
        )
    except (ValueError, TypeError, OverflowError, LookupError) as error:
        raise InputError(f"{path}: picture {picture} has a point without two numbers ({error!r})") from error
    if len(points) not in COUNTS:
        raise InputError(
            f"{path}: picture {picture} has a face of {len(points)} points; {COUNTS_SAID} can be read"
        )
    return seventy(points)


def _times(pictures: list[Any]) -> dict[str, np.ndarray]:
    """Numbers by a time's name, of each face's picture, where every picture with a face says its own."""
    if not all(isinstance(picture, dict) for picture in pictures):
        return {}
    names = time_names(pictures[0])
    told = {name: [picture.get(name) for picture in pictures] for name in names}
    return {
        name: np.array(
            [math.inf if abs(number) > LATEST_S else number for number in numbers], dtype=np.float64
        )
        for name, numbers in told.items()
        if all(isinstance(number, int | float) for number in numbers)
    }
