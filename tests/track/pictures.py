"""Pictures of known numbers for the tests of cameras' sources: made, put into folders, and read to the end."""

from pathlib import Path

import cv2
import numpy as np

from tests.track.virtual import noise
from track.sources import Source


def numbered(number: int) -> np.ndarray:
    """A picture (48, 64, 3) whose grey level says its number, and which differs from the same one."""
    return noise(number) // 20 + np.uint8(60 + 8 * number)


def folder_of(path: Path, names: list[str]) -> Path:
    path.mkdir()
    for number, name in enumerate(names):
        cv2.imwrite(str(path / name), numbered(number))
    return path


def read_all(source: Source) -> list:
    pictures = []
    while (picture := source.read()) is not None:
        pictures.append(picture)
    source.close()
    return pictures
