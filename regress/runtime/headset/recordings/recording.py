"""One camera's pictures from a folder, a film or a dataset's renders, at the size that a network takes."""

import stat
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from facegen.documents import unreadable
from facegen.formats.film import FILMS
from regress.errors import InputError
from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.pictures.halves import half_of
from regress.runtime.headset.pictures.picture_file import (
    PICTURES,
    bits_note,
    fit_picture,
    read_picture,
)
from regress.runtime.headset.pictures.picture_stack import PictureStack
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.recordings.film_frames import Film
from regress.runtime.headset.recordings.film_times import times_beside
from regress.runtime.headset.recordings.frame_names import frame_names
from regress.runtime.headset.recordings.recorded_paths import of_address, pictures_in, whole_of, without_half

MOST_FRAMES = 500_000
"""Of one camera's recording, which is held in memory: 92 minutes at 90 a second, 4.6 GB at 96 x 96."""

_EXPECTED = 10_000
"""Frames of a film for which memory is taken before they come: what films say of their length may be wrong."""

_MOST_NUMBER = 2**62
"""A sample's number is less, as all frames' are."""


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
    film
        Whether times and rate are a film's own.
    fps
        Frames a second, where a film tells.
    time_s : (n,) float64 or None
        Seconds of the frames, rising, where a film or names tell them.
    note
        What a person should be told of the frames' order, or of lacking ones; empty where nothing.
    clock
        Whether times of a film are of a clock beside it, and not from its first frame.
    scaled_from : (n, 2) int64 or None
        Width and height of each picture before it was scaled; None where none was.
    placement
        What of the recorded pictures these are; None where they are only scaled.
    whole
        Whether that is all of pictures of another shape than the network's, as nobody placed them.
    """

    camera: str
    source: str
    numbers: np.ndarray
    numbered: bool
    pictures: np.ndarray
    faults: tuple[Fault | None, ...]
    film: bool = False
    fps: float | None = None
    time_s: np.ndarray | None = None
    note: str = ""
    clock: bool = False
    scaled_from: np.ndarray | None = None
    placement: CameraPlacement | None = None
    whole: bool = False


def read_recording(
    path: Path,
    camera: str,
    *,
    width: int,
    height: int,
    bits: int | None = None,
    placement: CameraPlacement | None = None,
    choose: Callable[[int], np.ndarray] | None = None,
    as_recorded: bool = False,
) -> Recording:
    """Read a folder of pictures or a film, in grey, scaled where only the size differs.

    ``take/both#left`` is the left half of each picture, where one camera shows both eyes. All of it is held in memory:
    28 kB a frame of three 96 x 96 views, 50 MB a minute.

    Parameters
    ----------
    bits
        How many of their 16 bits the camera uses, of pictures that have so many.
    placement
        What of them the network is to see.
    choose
        Which rows of so many frames are read; all by default.
    as_recorded
        Whether pictures stay whole, with bars that they have.

    Raises
    ------
    InputError
        Where the path is missing, is no folder or film, holds no pictures or too many; see ``read_picture``.
    """
    named = path
    path, half = without_half(path)
    try:
        kind = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(
            f"{path} does not exist; a folder of {camera}'s pictures or a film of them is needed{of_address(path)}"
        ) from None
    except OSError as error:
        raise unreadable(path, error) from None
    if not stat.S_ISDIR(kind) and (not stat.S_ISREG(kind) or path.suffix.lower() not in FILMS):
        raise InputError(f"{path} is neither a folder nor a film; films end in {', '.join(FILMS)}")
    size = width, height
    whole = None if placement is not None or as_recorded else whole_of(named, size, bits=bits)
    if stat.S_ISDIR(kind):
        recording = _read_folder(path, camera, size, bits, placement or whole, choose, half)
    else:
        recording = _read_film(path, camera, size, placement or whole, choose, half)
    return recording if whole is None else replace(recording, whole=True)


def _read_folder(
    path: Path,
    camera: str,
    size: tuple[int, int],
    bits: int | None,
    placement: CameraPlacement | None,
    choose: Callable[[int], np.ndarray] | None,
    half: str,
) -> Recording:
    files = pictures_in(path)
    if not files:
        raise InputError(f"{path} has no pictures of {camera}; {', '.join(PICTURES)} can be read")
    names = frame_names(files)
    rows = np.arange(len(files)) if choose is None else choose(len(files))
    _check_count(len(rows), path)
    width, height = size
    stack = PictureStack(len(rows), size)
    for row in rows:
        file = names.files[row]
        stack.add(read_picture(file, width=width, height=height, bits=bits, placement=placement, half=half))
    odd = f"names do not count frames ({names.odd.name} among them); counted from 0" if names.odd else ""
    dark = set(stack.fields["faults"]) == {Fault.BLACK}
    told = "; ".join(filter(None, (odd, bits_note(names.files[rows[0]], bits) if dark else "")))
    return Recording(
        camera=camera,
        source=str(path),
        numbers=rows if names.numbers is None else np.array(names.numbers, dtype=np.int64)[rows],
        numbered=names.numbers is not None,
        time_s=None if names.time_s is None else np.array(names.time_s)[rows],
        note=f"{camera}: {told}" if told else "",
        placement=placement,
        **stack.fields,
    )


def _read_film(
    path: Path,
    camera: str,
    size: tuple[int, int],
    placement: CameraPlacement | None,
    choose: Callable[[int], np.ndarray] | None,
    half: str,
) -> Recording:
    width, height = size
    numbers, times = [], []
    with Film(path) as film:
        # of a film that does not say how long it is as much as of one that is just long enough
        chosen = None if choose is None else set(choose(film.length or MOST_FRAMES).tolist())
        stack = PictureStack(min(film.length, _EXPECTED) if choose is None else len(chosen), size)
        for frame in film.frames(chosen):
            stack.add(fit_picture(half_of(frame.grey, half), width=width, height=height, placement=placement))
            _check_count(len(stack), path)
            numbers.append(frame.number)
            times.append(frame.time_s)
        fps, lacking = film.fps, film.lacking
    if not numbers:
        raise InputError(f"{path} cannot be read as a film: it has no frames, or a codec that OpenCV lacks")
    time_s = np.array(times)
    beside, told = (None, "") if choose is not None else times_beside(path, len(numbers))
    notes = "; ".join(filter(None, (lacking, told)))
    rises = np.isfinite(time_s).all() and (np.diff(time_s) > 0).all() and len(time_s) > 1
    own_s = time_s if rises else None if fps is None else np.array(numbers) / fps
    return Recording(
        camera=camera,
        source=str(path),
        numbers=np.array(numbers),
        numbered=False,
        film=True,
        fps=fps,
        note=f"{camera}: {notes}" if notes else "",
        time_s=own_s if beside is None else beside,
        clock=beside is not None,
        placement=placement,
        **stack.fields,
    )


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
    stack = PictureStack(len(files), (width, height))
    for number in sorted(files):
        stack.add(read_picture(files[number], width=width, height=height))
    return Recording(
        camera=camera,
        source=str(dataset),
        numbers=np.array(sorted(files), dtype=np.int64),
        numbered=True,
        **stack.fields,
    )


def _check_count(frames: int, path: Path) -> None:
    if frames > MOST_FRAMES:
        raise InputError(f"{path} has more than {MOST_FRAMES:,} frames of a camera; give it in parts")
