"""The table of input formats, and the choice among them."""

import dataclasses
import os
import shlex
import stat
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from facegen.documents import unreadable
from facegen.formats.film import FILMS
from regress.errors import InputError
from regress.runtime.inputs import arrays, ck_plus, coco, dlib_xml, instances, pts, tables
from regress.runtime.inputs.frames import Frames


@dataclass(frozen=True, kw_only=True)
class Reader:
    """One input format.

    Parameters
    ----------
    description
        For people, with the ending.
    matches
        Whether a path looks like this format.
    read
        Path to frames.
    """

    description: str
    matches: Callable[[Path], bool]
    read: Callable[[Path], Frames]


READERS: dict[str, Reader] = {
    "ck_plus": Reader(
        description="a folder of CK+ landmarks", matches=ck_plus.is_ck_plus, read=ck_plus.read_ck_plus
    ),
    "openpose_folder": Reader(
        description="a folder of OpenPose's .json files",
        matches=instances.is_folder,
        read=instances.read_folder,
    ),
    "pts_folder": Reader(description="a folder of .pts files", matches=Path.is_dir, read=pts.read_folder),
    "pts": Reader(description="a .pts file", matches=pts.is_pts, read=pts.read_one),
    "npy": Reader(
        description="an .npy or .npz file (n, 68, 2) or (n, 478, 2)",
        matches=arrays.is_array,
        read=arrays.read_array,
    ),
    "dlib_xml": Reader(description="a dlib .xml", matches=dlib_xml.is_dlib_xml, read=dlib_xml.read_dlib_xml),
    "coco": Reader(
        description="a COCO keypoints, OpenPose, mmpose or MediaPipe .json",
        matches=coco.is_json,
        read=coco.read_json,
    ),
    "csv": Reader(
        description="an OpenFace, py-feat or other .csv of points",
        matches=tables.is_table,
        read=tables.read_table,
    ),
}
"""Tried in this order."""


def read_frames(path: str | os.PathLike[str]) -> Frames:
    """Read landmarks from any known file.

    Raises
    ------
    InputError, facegen.formats.FormatError
        Where the file does not exist, is of no known format, is not what its format says, or where no frame
        has all its landmarks.
    """
    path = Path(path)
    try:
        kind = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(f"{path} does not exist") from None
    except OSError as error:
        raise unreadable(path, error) from None
    if not (stat.S_ISREG(kind) or stat.S_ISDIR(kind)):
        raise InputError(f"{path} is a pipe or a device; give a file, or - for lines on standard input")
    try:
        frames = _reader_of(path).read(path)
    except OSError as error:  # also a folder in which others remove files
        raise InputError(f"{path} cannot be read: {error.strerror or error}") from error
    frames = dataclasses.replace(frames, labels=tuple(map(_printable, frames.labels)))
    if not frames.usable.any():
        raise InputError(
            f"{path} holds no usable frame: each of its {len(frames.points)} has missing landmarks"
        )
    return frames


def _reader_of(path: Path) -> Reader:
    reader = next((reader for reader in READERS.values() if reader.matches(path)), None)
    if reader is None:
        if path.suffix.lower() in FILMS:
            raise InputError(
                f"{path} is a film, and landmarks of it are needed; "
                f"track --fast --no-page --camera {shlex.quote(str(path))} --record weights.csv finds them itself"
            )
        known = ", ".join(reader.description for reader in READERS.values())
        piped = f"; lines of 136 numbers come by a pipe, as in regress predict - < {shlex.quote(str(path))}"
        lines = piped if path.suffix.lower() == ".txt" else ""
        raise InputError(f"{path} is of no known format; {known} can be read{lines}")
    return reader


def _printable(label: str) -> str:
    """A label that is text in UTF-8: names of files need not be, nor strings in JSON."""
    return label.encode(errors="surrogatepass").decode(errors="replace")
