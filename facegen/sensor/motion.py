"""Blurs pictures by motion, evenly along a short straight line while they are exposed."""

import numpy as np


def blurred(image: np.ndarray, motion_px: tuple[float, float]) -> np.ndarray:
    """Mean of an image (h, w) over its way by ``motion_px`` (right, down), half of it before and half after."""
    steps = 2 * int(np.ceil(np.hypot(*motion_px))) + 1 if any(motion_px) else 1
    total = np.zeros(image.shape)
    for k in range(steps):
        share = (k + 0.5) / steps - 0.5
        total += _moved(image, share * motion_px[0], share * motion_px[1])
    return total / steps


def _moved(image: np.ndarray, right_px: float, down_px: float) -> np.ndarray:
    """The image moved by fractions of pixels, linearly between them; borders go on outwards."""
    for axis, step in ((1, right_px), (0, down_px)):
        size = image.shape[axis]
        place = np.clip(np.arange(size) - step, 0.0, size - 1.0)
        first = np.minimum(place.astype(np.int64), size - 2)
        weight = (place - first).reshape((1, -1) if axis == 1 else (-1, 1))
        image = np.take(image, first, axis) * (1.0 - weight) + np.take(image, first + 1, axis) * weight
    return image
