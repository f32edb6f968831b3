"""Encodes pictures for an avatar's file, and noise to paint them with."""

from dataclasses import dataclass

import cv2
import numpy as np

JPEG_QUALITY = 88


def png(picture: np.ndarray) -> bytes:
    """PNG of a picture (h, w), (h, w, 3) or (h, w, 4) uint8, red first."""
    return _encoded(".png", picture, [cv2.IMWRITE_PNG_COMPRESSION, 9])


def jpeg(picture: np.ndarray, quality: int = JPEG_QUALITY) -> bytes:
    """JPEG of a picture (h, w, 3) uint8, red first."""
    return _encoded(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])


def _encoded(kind: str, picture: np.ndarray, settings: list[int]) -> bytes:
    if picture.ndim == 3:
        order = [2, 1, 0, 3][: picture.shape[2]]
        picture = np.ascontiguousarray(picture[..., order])
    return cv2.imencode(kind, picture, settings)[1].tobytes()


@dataclass(frozen=True, kw_only=True, eq=False)
class Waves:
    """Plane waves that add to noise: ``direction`` (n, 3), about 1 long, and ``phase`` (n,) in radians."""

    direction: np.ndarray
    phase: np.ndarray


def draw_waves(rng: np.random.Generator, count: int = 20) -> Waves:
    """Draw waves in all directions."""
    direction = rng.standard_normal((count, 3))
    direction *= (rng.uniform(0.6, 1.4, count) / np.linalg.norm(direction, axis=1))[:, None]
    return Waves(direction=direction, phase=rng.uniform(0.0, 2.0 * np.pi, count))


def noise(points: np.ndarray, wavelength_m: float, waves: Waves) -> np.ndarray:
    """Smooth noise at points (n, 3), about -1 to 1, whose spots are about half of ``wavelength_m`` wide."""
    turns = (points @ (waves.direction.T * (2.0 * np.pi / wavelength_m))).astype(
        np.float32
    ) + waves.phase.astype(np.float32)
    return np.cos(turns).sum(axis=1) * np.sqrt(2.0 / len(waves.phase)) / 1.6
