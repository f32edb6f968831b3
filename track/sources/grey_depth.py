"""Grey pictures of 16 bits, of which cameras use 10 or 12: OpenCV keeps the upper eight alone, nearly black."""

import cv2
import numpy as np

_Y16 = cv2.VideoWriter.fourcc(*"Y16 ")

_BITS = (8, 10, 12, 14, 16)
"""That sensors have."""


class GreyDepth:
    """Brings a camera's pictures to eight bits; the brightest pixel so far says how many bits the camera has."""

    def __init__(self, *, width: int, height: int) -> None:
        self._shape, self._bits = (height, width), _BITS[0]

    def step(self, raw: np.ndarray) -> np.ndarray | None:
        """The next picture (h, w) uint8 from its bytes, None of one that came in part; in colour it stays as it is."""
        if raw.ndim == 3 and raw.shape[2] == 3:
            return raw
        words = raw.reshape(-1).view(np.uint8)
        height, width = self._shape
        if len(words) < 2 * height * width:
            return None
        pixels = words[: 2 * height * width].view("<u2").reshape(self._shape)
        used = int(pixels.max()).bit_length()
        self._bits = max(self._bits, next(bits for bits in _BITS if bits >= used))
        return (pixels >> (self._bits - 8)).astype(np.uint8)


def grey_depth(capture: cv2.VideoCapture) -> GreyDepth | None:
    """Let a camera of 16 grey bits give them as they are; None of any other camera, which stays as it is."""
    if int(capture.get(cv2.CAP_PROP_FOURCC)) != _Y16 or not capture.set(cv2.CAP_PROP_CONVERT_RGB, 0):
        return None
    width, height = (int(capture.get(name)) for name in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT))
    return GreyDepth(width=width, height=height)
