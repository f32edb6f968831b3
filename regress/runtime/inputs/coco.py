"""COCO keypoints in JSON: 68 triples (x, y, v) in ``keypoints``, or in COCO-WholeBody's ``face_kpts``.

Other numbers of points are of other orders (`regress.runtime.inputs.orders`), as 133 of a whole body. Results stand in
a list, without their pictures, and have a score between 0 and 1 for v.
"""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from facegen.documents import load_json
from facegen.formats.natural_order import NaturalOrder, natural_order
from regress.errors import InputError
from regress.runtime.documents import checked
from regress.runtime.inputs import instances, mesh_results
from regress.runtime.inputs.frames import Frames, of_pictures, stacked
from regress.runtime.inputs.orders import COUNTS, seventy
from regress.runtime.inputs.weights import holds_weights

_MOST_BYTES = 256 * 1024**2
"""Some 100,000 annotations; as Python's numbers they take four times as much memory."""

_Id = int | str


@dataclass(frozen=True, kw_only=True)
class _Image:
    id: _Id
    file_name: _Id | None = None


@dataclass(frozen=True, kw_only=True)
class _Annotation:
    id: _Id
    image_id: _Id
    keypoints: Any = None
    face_kpts: Any = None
    track_id: _Id | None = None


@dataclass(frozen=True, kw_only=True)
class _Coco:
    """What is read of such a file; the rest is left alone."""

    annotations: tuple[_Annotation, ...]
    images: tuple[_Image, ...] = ()


def is_json(path: Path) -> bool:
    """Whether this is a ``.json`` file."""
    return path.suffix.lower() == ".json"


def read_json(path: Path) -> Frames:
    """Frames of COCO's annotations and results, of a pose estimator's (`instances`) or MediaPipe's (`mesh_results`)."""
    try:
        document = load_json(path, most_bytes=_MOST_BYTES)
    except InputError as error:
        reason = str(error).removeprefix(f"{path}: ")
        raise InputError(f"{path} is not a COCO keypoints file: {reason}") from error
    for format_ in (instances, mesh_results):
        if format_.is_document(document):
            return format_.read_parsed(document, path)
    if holds_weights(document):
        raise InputError(f"{path} holds weights already; the landmarks that they came from are needed")
    return _read_coco(document, path)


def _read_coco(document: Any, path: Path) -> Frames:
    """Every annotation is a frame, by image and annotation id; points with v = 0 are missing.

    A frame is called by its picture's file name, or ``name/ID`` where a picture has several annotations. Each face of
    such pictures is a take of its own, by ``track_id`` where all have one, else by who was nearest before.
    Annotations without 68 points, as of bodies or boxes alone, are no faces. Pictures without a face have no frame, and
    take their time all the same.
    """
    results = isinstance(document, list) and all(isinstance(each, dict) for each in document)
    if results and document:
        document = {"annotations": [{"id": place, **each} for place, each in enumerate(document)]}
    try:
        document = checked(_Coco, document)
    except InputError as error:
        reason = str(error).removeprefix(f"{path}: ")
        raise InputError(
            f"{path} is not a COCO keypoints file: {reason}; results of OpenPose, of mmpose and of MediaPipe "
            "(faceLandmarks) are read as well"
        ) from error
    if not document.annotations:
        raise InputError(f"{path} has no annotation")
    names = {
        image.id: str(image.id if image.file_name is None else image.file_name) for image in document.images
    }
    annotations = sorted(
        (entry for entry in document.annotations if _numbers(entry) is not None),
        key=lambda entry: (_order(entry.image_id), _order(entry.id)),
    )
    if not annotations:
        raise InputError(
            f"{path}: annotations have no {3 * LANDMARK_COUNT} numbers in keypoints or face_kpts, "
            f"x y v of {LANDMARK_COUNT} points"
        )
    faces = Counter(entry.image_id for entry in annotations)
    named = [names.get(entry.image_id, str(entry.image_id)) for entry in annotations]
    labels = [
        name if faces[entry.image_id] == 1 else f"{name}/{entry.id}"
        for name, entry in zip(named, annotations, strict=True)
    ]
    points, irises = stacked((_face(entry, path) for entry in annotations), path)
    frames = Frames(points=points, labels=tuple(labels), time_s=None, source=str(path), irises=irises)
    pictures = sorted(names.keys() | {entry.image_id for entry in document.annotations}, key=_order)
    place = {picture: number for number, picture in enumerate(pictures)}
    of = [place[entry.image_id] for entry in annotations]
    return of_pictures(frames, of, named, _tracks(annotations))


def _tracks(annotations: list[_Annotation]) -> list[str] | None:
    """Which person each face is, where a file follows them from picture to picture."""
    tracks = [(entry.image_id, entry.track_id) for entry in annotations]
    if any(track is None for _, track in tracks) or len(set(tracks)) < len(tracks):
        return None
    return [str(track) for _, track in tracks]


def _order(key: _Id) -> tuple[bool, int | NaturalOrder]:
    """Numbers before names, which cannot be compared with them; names by the numbers in them."""
    return (True, natural_order(key)) if isinstance(key, str) else (False, key)


def _numbers(entry: _Annotation) -> list[Any] | None:
    """Those of a face's points, where the annotation has them; 68 go before others."""
    given = [one for one in (entry.keypoints, entry.face_kpts) if isinstance(one, list)]
    return next((one for count in COUNTS for one in given if len(one) == 3 * count), None)


def _face(entry: _Annotation, path: Path) -> np.ndarray:
    try:
        triples = np.array(_numbers(entry), dtype=np.float64).reshape(-1, 3)
    except (ValueError, TypeError, OverflowError) as error:
        raise InputError(
            f"{path}: annotation {entry.id} holds something that is not a number ({error})"
        ) from error
    seen = triples[:, 2:]
    face = seventy(np.column_stack([np.where(seen > 0, triples[:, :2], np.nan), seen]))
    return face[:, :2] if np.isin(face[:, 2], (0, 1, 2)).all() else instances.scored(face)
