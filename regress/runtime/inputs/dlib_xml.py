"""Training files of dlib: images, boxes and named parts in XML; several faces a picture."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.parsers import expat

import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.inputs.frames import Frames, of_pictures, stacked

_CHUNK_BYTES = 64 * 1024
"""Read at a time: nothing but faces is kept, whatever else the file holds."""

_TRUE = ("1", "true")
"""Of a box's ``ignore``, by which imglab marks what is no face to train on."""


def is_dlib_xml(path: Path) -> bool:
    """Whether this is an ``.xml`` file."""
    return path.suffix.lower() == ".xml"


def read_dlib_xml(path: Path) -> Frames:
    """Every box is a frame: ``picture.jpg``, or ``picture.jpg/2`` for the second box of a picture.

    Each person is a take of its own: the nearest to where one was in the picture before.

    A box without parts has no face; parts are counted from 0 by name, missing ones are NaN. Boxes that
    are to be ignored are no faces. Pictures without a box have no frame, and take their time all the same.
    """
    labels: list[str] = []
    pictures: list[int] = []
    names: list[str] = []

    def faces() -> Iterator[np.ndarray]:
        for name, box, picture, face in _boxes(path):
            labels.append(name if box == 1 else f"{name}/{box}")
            pictures.append(picture)
            names.append(name)
            yield face

    points, _ = stacked(faces(), path)
    frames = Frames(points=points, labels=tuple(labels), time_s=None, source=str(path))
    return of_pictures(frames, pictures, names)


class _Reading:
    """What of the file has been seen so far: faces that wait to be taken, and the box that is being read."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.whole: list[tuple[str, int, int, np.ndarray]] = []
        self.found = False
        self._image: str | None = None
        self._images = self._boxes = 0
        self._face: np.ndarray | None = None
        self._ignored = False

    def doctype(self, *_: object) -> None:
        raise InputError(
            f"{self.path} declares a document type, in which entities can hide gigabytes; dlib's files have none: "
            "take its line <!DOCTYPE ...> out"
        )

    def start(self, tag: str, attributes: Mapping[str, str]) -> None:
        if tag == "image" and self._image is None:
            self._image, self._boxes = attributes.get("file", ""), 0
            self._images += 1
        elif tag == "box" and self._image is not None and self._face is None:
            self._ignored = attributes.get("ignore") in _TRUE
            self._boxes += not self._ignored
            self._face = np.full((LANDMARK_COUNT, 2), np.nan)
        elif tag == "part" and self._face is not None:
            self._take_part(attributes)

    def end(self, tag: str) -> None:
        if tag == "box" and self._face is not None:
            if not self._ignored:
                self.whole.append((self._image, self._boxes, self._images, self._face))
                self.found = True
            self._face = None
        elif tag == "image" and self._face is None:
            self._image = None

    def _take_part(self, attributes: Mapping[str, str]) -> None:
        name, x, y = (attributes.get(key, "") for key in ("name", "x", "y"))
        try:
            index, place = int(name), (float(x), float(y))
        except ValueError as error:
            raise InputError(
                f"{self.path}: a part of {self._image} lacks a number: {dict(attributes)}"
            ) from error
        if not 0 <= index < LANDMARK_COUNT:
            raise InputError(
                f"{self.path}: {self._image} has a part {index}; the iBUG order of 0 to 67 is needed"
            )
        self._face[index] = place


def _boxes(path: Path) -> Iterator[tuple[str, int, int, np.ndarray]]:
    """Name of the picture, number of the box, number of the picture and face (68, 2), as the file is read."""
    reading, parser = _Reading(path), expat.ParserCreate()
    parser.StartDoctypeDeclHandler = reading.doctype
    parser.StartElementHandler, parser.EndElementHandler = reading.start, reading.end
    with open(path, "rb") as file:
        try:
            while chunk := file.read(_CHUNK_BYTES):
                parser.Parse(chunk, False)
                yield from reading.whole
                reading.whole.clear()
            parser.Parse(b"", True)
        except (expat.ExpatError, LookupError, ValueError) as error:  # the latter two: encodings
            raise InputError(f"{path} is not XML: {error}") from error
    if not reading.found:
        raise InputError(f"{path} holds no image with a box that counts; dlib's training files do")
