"""Training files of dlib: images, boxes and named parts in XML; several faces a picture."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames


def is_dlib_xml(path: Path) -> bool:
    """Whether this is an ``.xml`` file."""
    return path.suffix.lower() == ".xml"


def read_dlib_xml(path: Path) -> Frames:
    """Every box is a frame: ``picture.jpg``, or ``picture.jpg/2`` for the second box of a picture.

    A box without parts has no face; parts are counted from 0 by name, missing ones are NaN.
    """
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        raise InputError(f"{path} is not XML: {error}") from error
    faces, labels = [], []
    for image in root.iter("image"):
        name = image.get("file", "")
        for number, box in enumerate(image.iter("box"), start=1):
            faces.append(_face(box, path, name))
            labels.append(name if number == 1 else f"{name}/{number}")
    if not faces:
        raise InputError(f"{path} holds no image with a box; dlib's training files do")
    return Frames(points=np.stack(faces), labels=tuple(labels), time_s=None, source=str(path))


def _face(box: ElementTree.Element, path: Path, name: str) -> np.ndarray:
    points = np.full((LANDMARK_COUNT, 2), np.nan)
    for part in box.iter("part"):
        try:
            index, x, y = int(part.get("name", "")), float(part.get("x", "")), float(part.get("y", ""))
        except ValueError as error:
            raise InputError(f"{path}: a part of {name} lacks a number: {part.attrib}") from error
        if not 0 <= index < LANDMARK_COUNT:
            raise InputError(f"{path}: {name} has a part {index}; the iBUG order of 0 to 67 is needed")
        points[index] = x, y
    return points
