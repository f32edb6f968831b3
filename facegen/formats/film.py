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
        Where OpenCV has no writer for such files.
    """
    writer = None
    try:
        for frame in frames:
            if writer is None:
                size = frame.shape[1], frame.shape[0]
                # MPEG-4 part 2: the wheel's FFmpeg has no H.264 encoder
                writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"mp4v"), fps, size)
                if not writer.isOpened():
                    raise OSError(f"OpenCV cannot write films that end in {path.suffix} here")
            writer.write(cv2.cvtColor(frame, cv2.COLOR_RGB2BGR))
    finally:
        if writer is not None:
            writer.release()
