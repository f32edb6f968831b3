"""One camera's pictures from a folder, a film or a dataset's renders, at the size that a network takes."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

import cv2
import numpy as np

from regress.errors import InputError
from regress.runtime.headset.faults import Fault, picture_fault

PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm", ".webp")
FILMS = (".mp4", ".avi", ".mkv", ".mov", ".webm", ".m4v")

ASPECT = 0.02
"""Relative difference of aspect ratios up to which a picture is only scaled: 400 x 400 for 96 x 96, not 640 x 400."""

_NUMBER = re.compile(r"(.*?)(\d+)\D*", re.DOTALL)
"""What stands before the last number of a file's name, and that number, before its ending."""

_DECIMAL = re.compile(r"\d+\.\d+")
_CLOCK = re.compile(r"\d{9,}\.\d+")
"""Seconds since 1970 with a fraction."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Recording:
    """What one camera recorded: n pictures, of which some may be at fault.

    Parameters
    ----------
    camera, source
        Name, and the folder or the film.
    numbers : (n,) int64
        Of the frames, ascending: from the files' names, or counted from 0.
    numbered
        Whether file names gave the numbers.
    pictures : (n, h, w) uint8
        At the network's size; 0 where a frame is at fault.
    faults
        Of each frame.
    fps
        Frames a second, where a film tells.
    scaled_from : (n, 2) int64 or None
        Width and height of each picture before it was scaled; None where none was.
    """

    camera: str
    source: str
    numbers: np.ndarray
    numbered: bool
    pictures: np.ndarray
    faults: tuple[Fault | None, ...]
    fps: float | None = None
    scaled_from: np.ndarray | None = None


def read_recording(path: Path, camera: str, *, width: int, height: int, bits: int | None = None) -> Recording:
    """Read a folder of pictures or a film, in grey, scaled where only the size differs.

    All of it is held in memory: 28 kB a frame of three 96 x 96 views, 50 MB a minute.

    Parameters
    ----------
    bits
        How many of their 16 bits the camera uses, of pictures that have so many.

    Raises
    ------
    InputError
        Where the path is missing, is no folder or film, or holds no pictures; see ``read_picture``.
    """
    if path.is_dir():
        files = [file for file in path.iterdir() if file.suffix.lower() in PICTURES]
        if not files:
            raise InputError(f"{path} has no pictures of {camera}; {', '.join(PICTURES)} can be read")
        numbers, files = _in_order(files)
        fitted = [read_picture(file, width=width, height=height, bits=bits) for file in files]
        return _recording(camera, path, numbers, fitted)
    if not path.exists():
        raise InputError(
            f"{path} does not exist; a folder of {camera}'s pictures or a film of them is needed"
        )
    if path.suffix.lower() not in FILMS:
        raise InputError(f"{path} is neither a folder nor a film; films end in {', '.join(FILMS)}")
    film = cv2.VideoCapture(str(path))
    try:
        fps = film.get(cv2.CAP_PROP_FPS)
        fitted = [fit_picture(frame, width=width, height=height) for frame in _film_frames(film)]
    finally:
        film.release()
    if not fitted:
        raise InputError(f"{path} cannot be read as a film: it has no frames, or a codec that OpenCV lacks")
    return _recording(camera, path, [], fitted, fps=fps if 0 < fps < 1000 else None)


def read_rendered(dataset: Path, camera: str, *, width: int, height: int) -> Recording:
    """Read a camera's pictures of a facegen dataset, by sample number.

    Raises
    ------
    InputError
        Where the dataset has no such pictures.
    """
    files = {int(file.parent.name): file for file in dataset.glob(f"renders/*/*/{camera}.png")}
    if not files:
        raise InputError(f"{dataset} has no rendered pictures of {camera} (renders/000/000000/{camera}.png)")
    fitted = [read_picture(files[number], width=width, height=height) for number in sorted(files)]
    return _recording(camera, dataset, sorted(files), fitted)


@dataclass(frozen=True, kw_only=True, eq=False)
class FittedPicture:
    """A picture at the network's size.

    Parameters
    ----------
    picture : (h, w) uint8
        0 where it is at fault.
    fault
        What is wrong with it.
    scaled_from
        Its own width and height, where it was scaled.
    """

    picture: np.ndarray
    fault: Fault | None
    scaled_from: tuple[int, int] | None


def read_picture(path: Path, *, width: int, height: int, bits: int | None = None) -> FittedPicture:
    """Read a picture in grey and bring it to a size; a file that is no picture is a fault of it.

    Parameters
    ----------
    bits
        How many of its 16 bits the camera uses, where the picture has so many: files do not say.

    Raises
    ------
    InputError
        Where a picture has 16 bits and ``bits`` is not given, or a level that they do not hold; where it has numbers of
        another kind.
    """
    try:
        data = np.frombuffer(path.read_bytes(), dtype=np.uint8)
        grey = cv2.imdecode(data, cv2.IMREAD_GRAYSCALE | cv2.IMREAD_ANYDEPTH) if len(data) else None
    except (OSError, cv2.error):
        grey = None
    if grey is not None and grey.dtype != np.uint8:
        grey = _eight_bits(grey, path, bits)
    return fit_picture(grey, width=width, height=height)


def _eight_bits(grey: np.ndarray, path: Path, bits: int | None) -> np.ndarray:
    if grey.dtype != np.uint16:
        raise InputError(f"{path} has pixels of type {grey.dtype}; pictures of 8 or 16 bits can be read")
    if bits is None:
        raise InputError(
            f"{path} has 16 bits a pixel, and the brightest is {grey.max()}; --bits says how many of them the camera "
            f"uses (10 for levels to 1023)"
        )
    if grey.max() >= 1 << bits:
        raise InputError(
            f"{path} has the level {grey.max()}, and --bits {bits} holds levels to {(1 << bits) - 1}; give more, or 16 "
            f"where the camera's bits are the upper ones"
        )
    return (grey >> (bits - 8)).astype(np.uint8)


def fit_picture(grey: np.ndarray | None, *, width: int, height: int) -> FittedPicture:
    """Bring a grey picture, or None for an unreadable one, to a size, if only the size differs."""
    scaled_from, fault = None, None
    if grey is None:
        fault = Fault.UNREADABLE
    elif grey.shape != (height, width):
        scaled_from = grey.shape[1], grey.shape[0]
        if abs(scaled_from[0] * height / (scaled_from[1] * width) - 1) > ASPECT:
            fault = Fault.SHAPE
        else:
            grey = cv2.resize(grey, (width, height), interpolation=cv2.INTER_AREA)
    fault = fault or picture_fault(grey)
    picture = np.zeros((height, width), dtype=np.uint8) if fault else grey
    return FittedPicture(
        picture=picture, fault=fault, scaled_from=None if fault is Fault.SHAPE else scaled_from
    )


def _in_order(files: list[Path]) -> tuple[list[int], list[Path]]:
    """Files by their numbers, or by name and without numbers where that of a name says only a part of the order.

    It does where other digits or words before it differ, and in times of the clock, as 1700000000.25.
    """
    files = sorted(files)
    found = [_NUMBER.fullmatch(file.stem) for file in files]
    clock = all(_CLOCK.fullmatch(file.stem) for file in files)
    if not clock and all(found) and len({match[1] for match in found}) == 1:
        numbers = [int(match[2]) for match in found]
        if len(set(numbers)) == len(files):
            pairs = sorted(zip(numbers, files, strict=True))
            return [number for number, _ in pairs], [file for _, file in pairs]
    if all(_DECIMAL.fullmatch(file.stem) for file in files):
        return [], sorted(files, key=lambda file: Decimal(file.stem))
    return [], sorted(files, key=lambda file: _natural(file.stem))


def _natural(name: str) -> list[str | int]:
    """Key that sorts 2 before 10."""
    return [int(part) if part.isdecimal() else part for part in re.split(r"(\d+)", name)]


def _film_frames(film: cv2.VideoCapture) -> Iterator[np.ndarray]:
    while True:
        there, frame = film.read()
        if not there:
            return
        yield cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) if frame.ndim == 3 else frame


def _recording(
    camera: str, source: Path, numbers: list[int], fitted: list[FittedPicture], *, fps: float | None = None
) -> Recording:
    """Fitted pictures as a recording; without numbers they are counted."""
    height, width = fitted[0].picture.shape
    scaled = any(one.scaled_from for one in fitted)
    return Recording(
        camera=camera,
        source=str(source),
        numbers=np.array(numbers or range(len(fitted)), dtype=np.int64),
        numbered=bool(numbers),
        pictures=np.array([one.picture for one in fitted]),
        faults=tuple(one.fault for one in fitted),
        fps=fps,
        scaled_from=np.array([one.scaled_from or (width, height) for one in fitted]) if scaled else None,
    )
