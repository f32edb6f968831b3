"""Resamples pictures to the squares that encoders see, by the same rule in training and in the exported graph."""

import math

import cv2
import numpy as np


def reduced(pictures: np.ndarray, size: int) -> np.ndarray:
    """Pictures (n, h, w) uint8, each side at most ``size``, each pixel by its area: sampling them would alias."""
    height, width = (min(side, size) for side in pictures.shape[1:])
    if (height, width) == pictures.shape[1:]:
        return pictures
    return np.stack(
        [cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA) for picture in pictures]
    )


def resampling_matrix(side: int, size: int) -> np.ndarray:
    """(size, side) float32: takes one side's pixels to the square's; ``rows @ picture @ columns.T`` is the square.

    Parameters
    ----------
    side, size
        Pixels of the camera's picture and of the square.
    """
    middle = min(side, size)
    return (linear_matrix(middle, size) @ _area(side, middle)).astype(np.float32)


def warp_matrix(
    width: int, height: int, size: int, *, shift: np.ndarray, scale: float, angle_rad: float, flipped: bool
) -> np.ndarray:
    """(2, 3) float64: takes a square's pixels to a picture's, as ``cv2.WARP_INVERSE_MAP`` wants it.

    Without displacement it samples the picture where ``resampling_matrix`` does.

    Parameters
    ----------
    width, height
        Of the reduced picture.
    shift : (2,) float
        Of the picture's width and height.
    scale, angle_rad
        About the picture's middle.
    """
    # spelt out: this runs for every picture of every batch
    cosine, sine, side = math.cos(angle_rad), math.sin(angle_rad), -1.0 if flipped else 1.0
    across, down, half = scale * width / size, scale * height / size, (size - 1) / 2
    a, b, c, d = across * cosine * side, -across * sine, down * sine * side, down * cosine
    x, y = (width - 1) / 2 + shift[0] * width, (height - 1) / 2 + shift[1] * height
    return np.array([[a, b, x - half * (a + b)], [c, d, y - half * (c + d)]])


def linear_matrix(side: int, size: int) -> np.ndarray:
    """(size, side): samples ``side`` pixels linearly at the middles of ``size``; at most half as many do not alias."""
    centres = np.clip((np.arange(size) + 0.5) * side / size - 0.5, 0, side - 1)
    return np.clip(1 - np.abs(centres[:, None] - np.arange(side)), 0, None)


def _area(side: int, size: int) -> np.ndarray:
    edges = np.arange(size + 1) * side / size
    pixels = np.arange(side)
    overlap = np.minimum(edges[1:, None], pixels + 1) - np.maximum(edges[:-1, None], pixels)
    return np.clip(overlap, 0, None) * size / side
