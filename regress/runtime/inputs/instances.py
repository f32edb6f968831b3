"""Faces of pose estimators in JSON: OpenPose's ``people``, a file a picture, and mmpose's ``instances``.

OpenPose writes 70 points of a face, the last two of which are irises; mmpose those of the dataset that its model
learned, as 133 of a body (`regress.runtime.inputs.orders`). Neither says who is who, nor when pictures were taken.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from facegen.documents import load_json
from facegen.formats.litter import is_litter
from facegen.formats.natural_order import natural_order
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames, of_pictures, stacked
from regress.runtime.inputs.orders import COUNTS, seventy

SCORE_LEAST = 0.3
"""Mean score of a face's points in results below which there is none: what mmpose draws from on itself."""

_ENDING = "_keypoints.json"
"""Of OpenPose's files."""

_MOST_BYTES = 16 * 1024**2
"""Of one picture: some thousand people."""


def is_folder(path: Path) -> bool:
    """Whether this is a folder of OpenPose's files."""
    return path.is_dir() and next(_files(path), None) is not None


def read_folder(path: Path) -> Frames:
    """A picture a file, in the order of the numbers in their names; those without a face take their time."""
    files = sorted(_files(path), key=lambda file: natural_order(file.name))
    documents = (load_json(file, most_bytes=_MOST_BYTES) for file in files)
    names = [file.name.removesuffix(_ENDING) for file in files]
    return _frames(
        [_people(document, file) for document, file in zip(documents, files, strict=True)], names, path
    )


def is_document(document: object) -> bool:
    """Whether parsed JSON is of one of both."""
    if isinstance(document, dict):
        return "people" in document or "instance_info" in document
    return (
        isinstance(document, list)
        and bool(document)
        and all(
            isinstance(each, dict) and ("instances" in each or "keypoint_scores" in each) for each in document
        )
    )


def read_parsed(document: Any, path: Path) -> Frames:
    """Frames of what `is_document` has accepted: one picture, or all of a film."""
    if isinstance(document, dict) and "people" in document:
        return _frames([_people(document, path)], [path.name.removesuffix(_ENDING)], path)
    pictures = document["instance_info"] if isinstance(document, dict) else document
    if not isinstance(pictures, list):
        raise InputError(f"{path}: instance_info is no list of pictures, as mmpose writes one")
    if pictures and all(isinstance(each, dict) and "instances" not in each for each in pictures):
        pictures = [{"instances": pictures}]  # of one picture
    faces, names = [], []
    for place, picture in enumerate(pictures):
        if not isinstance(picture, dict) or not isinstance(picture.get("instances"), list):
            raise InputError(f"{path}: picture {place} has no list of instances, as mmpose writes one")
        faces.append([_instance(each, path, place) for each in picture["instances"]])
        names.append(str(picture.get("frame_id", place)))
    return _frames(faces, names, path)


def _files(folder: Path) -> Iterator[Path]:
    return (file for file in folder.glob(f"*{_ENDING}") if not is_litter(file.name))


def _people(document: Any, path: Path) -> list[np.ndarray | None]:
    """Points (70, 2) of everyone whose face OpenPose was asked for; NaN where it is not seen."""
    people = document.get("people") if isinstance(document, dict) else None
    if not isinstance(people, list) or not all(isinstance(person, dict) for person in people):
        raise InputError(f"{path} has no list of people, as OpenPose writes one")
    faces = []
    for person in people:
        given = person.get("face_keypoints_2d") or []
        if not given:
            faces.append(None)
            continue
        numbers = _numbers(given, path)
        if numbers.size != 3 * (LANDMARK_COUNT + 2):
            raise InputError(
                f"{path}: face_keypoints_2d has {numbers.size} numbers; {3 * (LANDMARK_COUNT + 2)} are needed, x y c "
                f"of {LANDMARK_COUNT + 2} points"
            )
        triples = numbers.reshape(-1, 3)
        faces.append(np.where(triples[:, 2:] > 0, triples[:, :2], np.nan))
    return faces


def _instance(instance: Any, path: Path, picture: int) -> np.ndarray | None:
    """Points (68 or 70, 2) of one of mmpose's instances; NaN where its scores say that there is no face."""
    if not isinstance(instance, dict):
        raise InputError(f"{path}: picture {picture} has an instance that is no table")
    points = _numbers(instance.get("keypoints"), path)
    if points.ndim != 2 or points.shape[1] not in (2, 3) or len(points) not in COUNTS:
        return None
    scores = _numbers(instance.get("keypoint_scores", np.ones(len(points)).tolist()), path)
    if scores.shape != (len(points),):
        raise InputError(f"{path}: picture {picture} has {scores.size} scores of {len(points)} points")
    return scored(seventy(np.column_stack([points[:, :2], scores])))


def scored(face: np.ndarray) -> np.ndarray:
    """Points (k, 2) of a face with a score behind each (k, 3); NaN where the mean score says that there is none."""
    return face[:, :2] if has_face(face[:LANDMARK_COUNT, 2]) else np.full((len(face), 2), np.nan)


def has_face(scores: np.ndarray) -> np.ndarray:
    """Whether scores (..., 68) of points say that there is a face (...)."""
    return scores.mean(axis=-1) >= SCORE_LEAST


def _numbers(given: Any, path: Path) -> np.ndarray:
    try:
        return np.array(given, dtype=np.float64)
    except (ValueError, TypeError, OverflowError) as error:
        raise InputError(f"{path} holds something that is not a number ({error})") from error


def _frames(pictures: list[list[np.ndarray | None]], names: list[str], path: Path) -> Frames:
    """Frames of the faces in each picture; who has none is left out, as are pictures without any."""
    faces, of, labels = [], [], []
    for number, (name, found) in enumerate(zip(names, pictures, strict=True)):
        known = [face for face in found if face is not None]
        for place, face in enumerate(known, start=1):
            faces.append(face)
            of.append(number)
            labels.append(name if len(known) == 1 else f"{name}/{place}")
    if not faces:
        raise InputError(
            f"{path} holds no face: OpenPose wants --face, and mmpose a model of whole bodies or of faces of "
            f"{LANDMARK_COUNT} or 98 points"
        )
    points, irises = stacked(faces, path)
    frames = Frames(points=points, labels=tuple(labels), time_s=None, source=str(path), irises=irises)
    return of_pictures(frames, of, [names[number] for number in of])
