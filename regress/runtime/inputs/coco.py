"""COCO keypoints in JSON: 68 triples (x, y, v) in ``keypoints``, or in COCO-WholeBody's ``face_kpts``."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames

_KEYS = ("keypoints", "face_kpts")


def is_coco(path: Path) -> bool:
    """Whether this is a ``.json`` file."""
    return path.suffix.lower() == ".json"


def read_coco(path: Path) -> Frames:
    """Every annotation is a frame, by image and annotation id; points with v = 0 are missing.

    A frame is called by its picture's file name, or ``name/ID`` where a picture has several annotations.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        names = {
            image["id"]: str(image.get("file_name", image["id"])) for image in document.get("images", [])
        }
        annotations = sorted(document["annotations"], key=lambda entry: (entry["image_id"], entry["id"]))
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"{path} is not a COCO keypoints file: {error!r}") from error
    if not annotations:
        raise InputError(f"{path} has no annotation")
    images = [entry["image_id"] for entry in annotations]
    labels = []
    for entry in annotations:
        name = names.get(entry["image_id"], str(entry["image_id"]))
        labels.append(name if images.count(entry["image_id"]) == 1 else f"{name}/{entry['id']}")
    points = np.stack([_face(entry, path) for entry in annotations])
    return Frames(points=points, labels=tuple(labels), time_s=None, source=str(path))


def _face(entry: dict[str, Any], path: Path) -> np.ndarray:
    values = next((entry[key] for key in _KEYS if len(entry.get(key) or ()) == 3 * LANDMARK_COUNT), None)
    if values is None:
        raise InputError(
            f"{path}: annotation {entry['id']} has no {3 * LANDMARK_COUNT} numbers in {' or '.join(_KEYS)}"
        )
    try:
        triples = np.array(values, dtype=np.float64).reshape(LANDMARK_COUNT, 3)
    except (ValueError, TypeError) as error:
        raise InputError(f"{path}: annotation {entry['id']} holds something that is not a number") from error
    return np.where(triples[:, 2:] > 0, triples[:, :2], np.nan)
