"""Writes films frame by frame, by OpenCV."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from facegen.console import silent_stderr
from facegen.errors import FormatError

WRITTEN_FILMS = (".mp4", ".avi", ".mkv", ".mov", ".webm", ".m4v")
"""Endings of films that can be written."""

FILMS = (*WRITTEN_FILMS, ".mjpeg", ".mjpg", ".mpg", ".mpeg", ".ts", ".wmv", ".3gp")
"""Endings of films that can be read, where FFmpeg in OpenCV has the codec."""

_VP9, _MPEG4_PART_2 = "VP90", "mp4v"


def encode_film(path: Path, frames: Iterable[np.ndarray], *, fps: float) -> None:
    """Write a film; what is there after an error is half a film, which the caller removes.

    Parameters
    ----------
    path
        The suffix says which container and codec: .webm holds VP9, which browsers play; .mp4, .avi, .mov and .mkv hold
        MPEG-4 part 2, which VLC and mpv play and browsers do not (OpenCV's wheel has no H.264 encoder), in a fortieth
        of the time.
    frames
        RGB pictures (h, w, 3) uint8 of one size, drawn as they are written.
    fps
        Frames a second.

    Raises
    ------
    FormatError
        Where the name is no text.
    OSError
        Where OpenCV has no writer for such files, or not every frame can be read back, as on a full disk.
    """
    import cv2

    check_film_path(path)
    writer, written = None, 0
    try:
        for frame in frames:
            if writer is None:
                codec = cv2.VideoWriter_fourcc(*(_VP9 if path.suffix.lower() == ".webm" else _MPEG4_PART_2))
                with silent_stderr():
                    writer = cv2.VideoWriter(str(path), codec, fps, (frame.shape[1], frame.shape[0]))
                if not writer.isOpened():
                    raise OSError(
                        f"OpenCV cannot write films that end in {path.suffix} here, or no space is left"
                    )
            writer.write(cv2.cvtColor(frame, cv2.COLOR_RGB2BGR))
            written += 1
    finally:
        if writer is not None:
            writer.release()
    readable = _count_frames(path) if written else 0  # the writer itself never says that a write has failed
    if readable != written:
        raise OSError(
            f"{readable} of {written} frames can be read back: no space is left, or the disk loses what is written"
        )


def check_film_path(path: Path) -> None:
    """Refuse a name that is no text in UTF-8: OpenCV crashes on it.

    Raises
    ------
    FormatError
        Where it is none.
    """
    try:
        str(path).encode()
    except UnicodeEncodeError:
        raise FormatError(f"{path}: is no name in UTF-8, and films need one; give it another") from None


def _count_frames(path: Path) -> int:
    import cv2

    film, count = cv2.VideoCapture(str(path)), 0
    while film.grab():
        count += 1
    film.release()
    return count
