"""Small takes of the tiny model's cameras: pictures of a known mean brightness that no two frames share."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import cv2
import numpy as np

from regress.runtime.headset.recordings.recording import Recording

HEIGHT, WIDTH = 12, 16


def pictures(means: Sequence[float], *, seed: int = 0) -> np.ndarray:
    """(n, 12, 16) uint8 of these mean grey levels, with 25 levels of texture."""
    rng = np.random.default_rng(seed)
    texture = rng.uniform(-25, 25, size=(len(means), HEIGHT, WIDTH))
    texture -= texture.mean(axis=(1, 2), keepdims=True)
    return np.clip(np.round(np.asarray(means, dtype=np.float64)[:, None, None] + texture), 0, 255).astype(
        np.uint8
    )


def recording(
    camera: str, stack: np.ndarray, *, numbers: Sequence[int] | None = None, **changes: object
) -> Recording:
    """A sound recording of these pictures."""
    settings = {
        "camera": camera,
        "source": f"take/{camera}",
        "numbers": np.arange(len(stack)) if numbers is None else np.array(numbers),
        "numbered": True,
        "pictures": stack,
        "faults": (None,) * len(stack),
        **changes,
    }
    return Recording(**settings)


def write_pictures(
    folder: Path, stack: np.ndarray, *, first: int = 0, name: str = "frame_{:04d}.png"
) -> Path:
    """Write a folder of pictures, numbered from ``first``."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, picture in enumerate(stack, start=first):
        assert cv2.imwrite(str(folder / name.format(number)), picture)
    return folder


def write_take(folder: Path, stacks: Mapping[str, np.ndarray], *, first: int = 0) -> list[str]:
    """Write a folder a camera; gives the options of ``regress headset predict`` that name them."""
    for camera, stack in stacks.items():
        write_pictures(folder / camera, stack, first=first)
    return [word for camera in stacks for word in ("--camera", f"{camera}={folder / camera}")]
