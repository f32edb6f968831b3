"""Writes COCO keypoints JSON as a stream: one category, its names and skeleton, one annotation an image.

References
----------
.. [1] COCO, "Data format", https://cocodataset.org/#format-data. Keypoints are flat triples x, y, v: v is 0
   for not labelled (then x = y = 0), 1 for labelled but hidden, 2 for visible. Skeletons count from 1. Keypoints are
   places of pixels, (0, 0) in the middle of the first; boxes count from the picture's corner, and (0, 0, width, height)
   is all of it, as ``pycocotools.mask`` fills them.
"""

import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_GROUPS

KEYPOINT_NAMES: tuple[str, ...] = tuple(
    f"{group}_{index}" for group, members in LANDMARK_GROUPS.items() for index in range(len(members))
)
"""Names of the 68 landmarks, in order: ``jaw_0`` is the subject's right end of the jaw."""

_CORNER_PX = 0.5
"""From the picture's corner, where boxes begin, to the middle of the first pixel, where points do."""

_CLOSED = ("right_eye", "left_eye", "outer_lip", "inner_lip")


def skeleton() -> list[list[int]]:
    """Pairs of neighbouring landmarks, counted from 1; eyes and lips are closed."""
    pairs = []
    for group, members in LANDMARK_GROUPS.items():
        pairs += [[index + 1, index + 2] for index in members[:-1]]
        if group in _CLOSED:
            pairs.append([members[-1] + 1, members[0] + 1])
    return pairs


@dataclass(frozen=True, kw_only=True)
class LabelledImage:
    """One image with one face.

    Attributes
    ----------
    number
        Becomes the image's id; the annotation's is one more, because COCO's tools take 0 for none.
    file_name, width, height
        Of the image.
    points
        (68, 2) pixels.
    visibility
        (68,) COCO's numbers, which are `facegen.conventions.Visibility`.
    """

    number: int
    file_name: str
    width: int
    height: int
    points: np.ndarray
    visibility: np.ndarray


def write_coco(
    path: Path, images: Callable[[], Iterable[LabelledImage]], *, info: dict, licence: str
) -> None:
    """Write a file in constant memory; ``images`` is called twice and must give the same both times.

    Text is ASCII, as JSON escapes the rest: ``pycocotools`` opens files in the locale's encoding.
    """
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        head = {
            "info": info,
            "licenses": [{"id": 1, "name": licence, "url": ""}],
            "categories": [
                {
                    "id": 1,
                    "name": "face",
                    "supercategory": "person",
                    "keypoints": list(KEYPOINT_NAMES),
                    "skeleton": skeleton(),
                }
            ],
        }
        file.write(json.dumps(head)[:-1])
        for name, entries in (("images", _images(images())), ("annotations", _annotations(images()))):
            file.write(f', "{name}": [')
            for index, entry in enumerate(entries):
                file.write(("\n" if index == 0 else ",\n") + json.dumps(entry))
            file.write("]")
        file.write("}\n")


def _images(images: Iterable[LabelledImage]) -> Iterator[dict]:
    for image in images:
        size = {"width": image.width, "height": image.height}
        yield {"id": image.number, "license": 1, "file_name": image.file_name, **size}


def _annotations(images: Iterable[LabelledImage]) -> Iterator[dict]:
    for image in images:
        labelled = image.visibility > 0
        if not labelled.any():
            continue  # a picture that shows no landmark has no annotation
        triples = np.where(labelled[:, None], np.column_stack([image.points, image.visibility]), 0.0)
        low, high = image.points[labelled].min(axis=0), image.points[labelled].max(axis=0)
        width, height = (high - low).tolist()
        yield {
            "id": image.number + 1,
            "image_id": image.number,
            "category_id": 1,
            "iscrowd": 0,
            "num_keypoints": int(labelled.sum()),
            "keypoints": [value for x, y, v in triples.tolist() for value in (x, y, int(v))],
            "bbox": [*(low + _CORNER_PX).tolist(), width, height],
            "area": width * height,
        }
