"""Where a camera's pictures lie: a folder, a film, or half of each picture; and how large they are."""

import os
from itertools import islice
from pathlib import Path

import numpy as np

from facegen.documents import unreadable
from regress.errors import InputError
from regress.runtime.even_rows import even_rows
from regress.runtime.headset.pictures.bars import LOOKED_AT, bars_of
from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.pictures.halves import half_of, half_size, split_half
from regress.runtime.headset.pictures.picture_file import PICTURES, decoded, eight_bits, whole_of_shape
from regress.runtime.headset.pictures.placement import NO_CUT, CameraPlacement
from regress.runtime.headset.recordings.film_frames import Film


def pictures_in(folder: Path) -> list[Path]:
    """Files by their ending; macOS writes ``._1.png`` beside 1.png on disks of other systems."""
    try:
        return [
            file
            for file in folder.iterdir()
            if file.suffix.lower() in PICTURES and not file.name.startswith(".")
        ]
    except OSError as error:
        raise unreadable(folder, error) from None


def without_half(path: Path) -> tuple[Path, str]:
    """A path, and the half of its pictures that stands behind it; a folder whose name ends so is whole."""
    whole, half = split_half(os.fspath(path))
    return (Path(whole), half) if half and not path.exists() else (path, "")


def of_address(path: Path) -> str:
    """What to do with a live camera's address."""
    scheme = path.parts[0] if path.parts else ""
    return "; recordings are read here, and `track` reads addresses" if scheme[1:].endswith(":") else ""


def recorded_size(path: Path) -> tuple[int, int]:
    """Width and height of most of a folder's pictures that can be read, or of a film; of their halves.

    Raises
    ------
    InputError
        Where there is none.
    """
    path, half = without_half(path)
    if path.is_dir():
        files = sorted(pictures_in(path))
        rows = even_rows(len(files), LOOKED_AT)  # whose commonest size is the folder's
        sizes = [size for row in rows if (size := _size_of(files[row]))]
        sizes = sizes or [size for size in islice(filter(None, map(_size_of, files)), 1)]
        if not sizes:
            raise InputError(f"{path} has no picture that can be read")
        return half_size(max(sizes, key=sizes.count), half)
    if not path.exists():
        raise InputError(f"{path} does not exist; a folder of pictures or a film is needed{of_address(path)}")
    with Film(path) as film:
        width, height = film.size
    if width < 1 or height < 1:
        raise InputError(f"{path} cannot be read as a film")
    return half_size((width, height), half)


def whole_of(path: Path, view: tuple[int, int], *, bits: int | None = None) -> CameraPlacement | None:
    """All of the pictures of a folder, a film or a file, where most have another shape than a view (width, height).

    Bars at the edges of a folder's or a film's pictures are left out; ``bits`` is as ``read_picture`` takes it.
    """
    try:
        if path.suffix.lower() in PICTURES:
            size, cut = _size_of(path), NO_CUT
        else:
            size = recorded_size(path)
            cut = _recorded_bars(path, size, bits)
    except InputError:  # not one can be read, which is told of each
        return None
    return None if size is None else whole_of_shape(size, view, cut)


def _recorded_bars(path: Path, size: tuple[int, int], bits: int | None) -> tuple[float, ...]:
    """What bars take of pictures (width, height) of a folder or a film: see `bars_of`."""
    path, half = without_half(path)
    if path.is_dir():
        files = sorted(pictures_in(path))
        pictures = [decoded(files[row]) for row in even_rows(len(files), LOOKED_AT)]
    else:
        with Film(path) as film:
            pictures = list(film.spread(LOOKED_AT))
    sound = [one for one in pictures if isinstance(one, np.ndarray)]
    eight = [one if one.dtype == np.uint8 else eight_bits(one, path, bits) for one in sound]
    grey = [half_of(one, half) for one in eight]
    alike = [one for one in grey if one.shape == size[::-1]]
    return bars_of(np.stack(alike)) if alike else NO_CUT


def _size_of(file: Path) -> tuple[int, int] | None:
    """Width and height as it is seen: by its header a picture may lie on its side, which EXIF says."""
    grey = decoded(file)
    return None if isinstance(grey, Fault) else (grey.shape[1], grey.shape[0])
