"""Films, frame by frame, by OpenCV."""

from collections.abc import Iterable
from pathlib import Path

import cv2
import numpy as np


def encode_film(path: Path, frames: Iterable[np.ndarray], *, fps: float) -> None:
    """Write a film; what is there after an error is half a film, which the caller removes.

    Parameters
    ----------
    path
        The suffix says which container: .mp4, .avi, .mov.
    frames
        RGB pictures (h, w, 3) uint8 of one size, drawn as they are written.
    fps
        Frames a second.

    Raises
    ------
    OSError
        Where OpenCV has no writer for such files, or not every frame can be read back, as on a full disk.
    """
    writer, written = None, 0
    try:
        for frame in frames:
            if writer is None:
                size = frame.shape[1], frame.shape[0]
                # MPEG-4 part 2: the wheel's FFmpeg has no H.264 encoder
                writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"mp4v"), fps, size)
                if not writer.isOpened():
                    raise OSError(
                        f"OpenCV cannot write films that end in {path.suffix} here, or no space is left"
                    )
            writer.write(cv2.cvtColor(frame, cv2.COLOR_RGB2BGR))
            written += 1
    finally:
        if writer is not None:
            writer.release()
    there = _count_frames(path) if written else 0  # the writer itself never says that a write has failed
    if there != written:
        raise OSError(
            f"{there} of {written} frames can be read back: no space is left, or the disk loses what is written"
        )


def _count_frames(path: Path) -> int:
    film, count = cv2.VideoCapture(str(path)), 0
    while film.grab():
        count += 1
    film.release()
    return count
