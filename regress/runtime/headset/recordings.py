"""One camera's pictures from a folder, a film or a dataset's renders, at the size that a network takes."""

import os
import re
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal
from itertools import count
from pathlib import Path

import cv2
import numpy as np

from facegen.documents import unreadable
from facegen.formats.film import FILMS, check_film_path
from facegen.formats.natural_order import natural_order
from facegen.formats.picture_size import MOST_PIXELS
from regress.errors import InputError
from regress.runtime.headset.faults import Fault
from regress.runtime.headset.pictures import (
    PICTURES,
    FittedPicture,
    decoded,
    fit_picture,
    read_picture,
)
from regress.runtime.headset.placement import CameraPlacement

MOST_FRAMES = 500_000
"""Of one camera's recording, which is held in memory: 92 minutes at 90 a second, 4.6 GB at 96 x 96."""

_MOST_NUMBER = 2**62
"""A frame's number is less: nanoseconds since 1970 are, and differences of numbers still fit 64 bits."""

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
    placement
        What of the recorded pictures these are; None where they are all of them.
    """

    camera: str
    source: str
    numbers: np.ndarray
    numbered: bool
    pictures: np.ndarray
    faults: tuple[Fault | None, ...]
    fps: float | None = None
    scaled_from: np.ndarray | None = None
    placement: CameraPlacement | None = None


def read_recording(
    path: Path,
    camera: str,
    *,
    width: int,
    height: int,
    bits: int | None = None,
    placement: CameraPlacement | None = None,
) -> Recording:
    """Read a folder of pictures or a film, in grey, scaled where only the size differs.

    All of it is held in memory: 28 kB a frame of three 96 x 96 views, 50 MB a minute.

    Parameters
    ----------
    bits
        How many of their 16 bits the camera uses, of pictures that have so many.
    placement
        What of them the network is to see.

    Raises
    ------
    InputError
        Where the path is missing, is no folder or film, holds no pictures or too many; see ``read_picture``.
    """
    try:
        kind = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(
            f"{path} does not exist; a folder of {camera}'s pictures or a film of them is needed"
        ) from None
    except OSError as error:
        raise unreadable(path, error) from None
    if stat.S_ISDIR(kind):
        files = _pictures_in(path)
        if not files:
            raise InputError(f"{path} has no pictures of {camera}; {', '.join(PICTURES)} can be read")
        _check_count(len(files), path)
        numbers, files = _in_order(files)
        fitted = [
            read_picture(file, width=width, height=height, bits=bits, placement=placement) for file in files
        ]
        return _recording(camera, path, numbers, fitted, placement=placement)
    if not stat.S_ISREG(kind) or path.suffix.lower() not in FILMS:
        raise InputError(f"{path} is neither a folder nor a film; films end in {', '.join(FILMS)}")
    check_film_path(path)
    film = _opened(path)
    try:
        fps = film.get(cv2.CAP_PROP_FPS)
        fitted = [
            fit_picture(frame, width=width, height=height, placement=placement)
            for frame in _film_frames(film, path)
        ]
    except cv2.error as error:
        raise InputError(f"{path} cannot be read as a film ({error.err})") from error
    finally:
        film.release()
    if not fitted:
        raise InputError(f"{path} cannot be read as a film: it has no frames, or a codec that OpenCV lacks")
    return _recording(camera, path, [], fitted, fps=fps if 0 < fps < 1000 else None, placement=placement)


def recorded_size(path: Path) -> tuple[int, int]:
    """Width and height of a folder's first readable picture, or of a film.

    Raises
    ------
    InputError
        Where there is none.
    """
    if path.is_dir():
        for file in sorted(_pictures_in(path)):
            grey = decoded(file)  # by its header a picture may lie on its side, which EXIF says
            if not isinstance(grey, Fault):
                return grey.shape[1], grey.shape[0]
        raise InputError(f"{path} has no picture that can be read")
    if not path.exists():
        raise InputError(f"{path} does not exist; a folder of pictures or a film is needed")
    check_film_path(path)
    film = _opened(path)
    try:
        width, height = (
            int(film.get(side)) for side in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT)
        )
    finally:
        film.release()
    if width < 1 or height < 1:
        raise InputError(f"{path} cannot be read as a film")
    return width, height


def read_rendered(dataset: Path, camera: str, *, width: int, height: int) -> Recording:
    """Read a camera's pictures of a facegen dataset, by sample number.

    Raises
    ------
    InputError
        Where the dataset has no such pictures.
    """
    files = {
        int(file.parent.name): file
        for file in dataset.glob(f"renders/*/*/{camera}.png")
        if file.parent.name.isdecimal() and int(file.parent.name) < _MOST_NUMBER
    }
    if not files:
        raise InputError(f"{dataset} has no rendered pictures of {camera} (renders/000/000000/{camera}.png)")
    _check_count(len(files), dataset)
    fitted = [read_picture(files[number], width=width, height=height) for number in sorted(files)]
    return _recording(camera, dataset, sorted(files), fitted)


def _in_order(files: list[Path]) -> tuple[list[int], list[Path]]:
    """Files by their numbers, or by name and without numbers where that of a name says only a part of the order.

    It does where other digits or words before it differ, and in times of the clock, as 1700000000.25.
    """
    files = sorted(files)
    found = [_NUMBER.fullmatch(file.stem) for file in files]
    clock = all(_CLOCK.fullmatch(file.stem) for file in files)
    if not clock and all(found) and len({match[1] for match in found}) == 1:
        numbers = [int(match[2]) for match in found]
        if len(set(numbers)) == len(files) and max(numbers) < _MOST_NUMBER:
            pairs = sorted(zip(numbers, files, strict=True))
            return [number for number, _ in pairs], [file for _, file in pairs]
    if all(_DECIMAL.fullmatch(file.stem) for file in files):
        return [], sorted(files, key=lambda file: Decimal(file.stem))
    return [], sorted(files, key=lambda file: natural_order(file.stem))


def _pictures_in(folder: Path) -> list[Path]:
    """Files by their ending; macOS writes ``._1.png`` beside 1.png on disks of other systems."""
    try:
        return [
            file
            for file in folder.iterdir()
            if file.suffix.lower() in PICTURES and not file.name.startswith(".")
        ]
    except OSError as error:
        raise unreadable(folder, error) from None


def _check_count(frames: int, path: Path) -> None:
    if frames > MOST_FRAMES:
        raise InputError(f"{path} has more than {MOST_FRAMES:,} frames of a camera; give it in parts")


def _opened(path: Path) -> cv2.VideoCapture:
    """A film whose pictures are turned as it says: telephones write them as the sensor lies."""
    film = cv2.VideoCapture(os.fspath(path))
    film.set(cv2.CAP_PROP_ORIENTATION_AUTO, 1)
    return film


def _film_frames(film: cv2.VideoCapture, path: Path) -> Iterator[np.ndarray]:
    width, height = (film.get(side) for side in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT))
    if width * height > MOST_PIXELS:
        raise InputError(
            f"{path} has frames of {width:g} x {height:g} pixels; at most {MOST_PIXELS:,} are read"
        )
    for number in count(1):
        there, frame = film.read()
        if not there:
            return
        _check_count(number, path)
        yield cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY) if frame.ndim == 3 else frame


def _recording(
    camera: str,
    source: Path,
    numbers: list[int],
    fitted: list[FittedPicture],
    *,
    fps: float | None = None,
    placement: CameraPlacement | None = None,
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
        placement=placement,
    )
