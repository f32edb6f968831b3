"""Says which part of a camera's picture a network is to see, and takes pixels from one to the other."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, ClassVar

import cv2
import numpy as np
from annotated_types import Interval, Len

Share = Annotated[float, Interval(ge=-2, le=3)]
"""Of a picture's width or height; what the network sees may have its middle outside of the picture."""

Level = Annotated[float, Interval(ge=-255, le=510)]
"""A grey level; flat pictures are stretched from levels that no pixel has."""

Edge = Annotated[float, Interval(ge=0, le=0.45)]
"""Share of a picture's width or height that is left out at an edge."""

NO_CUT = (0.0, 0.0, 0.0, 0.0)

_FADES = (0.02, 0.08)
"""Blurs of what lies beyond a picture's edges, of the view's width: each is whole from one and a half of it outside.

Repeated edges alone are streaks, which networks take for lids and irises. Where an eye fills its picture, fading them
takes a fifth off the pupil's error (docs/measurements/headset-networks.md)."""


@dataclass(frozen=True, kw_only=True)
class CameraPlacement:
    """Where in a camera's picture the view lies that a network is to see; beyond the edges their pixels fade out.

    Parameters
    ----------
    x, y
        Middle of the view, as shares of the picture's width and height.
    size
        Width of the view over that of the picture: below 1 the picture is cropped, above it is widened.
    stretch
        How many times as wide as high a pixel is: 2 where two views were shrunk into halves of one picture.
    cut
        Shares of the recorded picture that are left out at its left, top, right and bottom edge, as bars are; all else
        is of what they leave.
    roll_deg
        By how much the view is turned in the picture, clockwise as the picture is looked at.
    mirror
        Whether the view is looked at in a mirror.
    low, high
        Grey levels of the picture that become 2nd and 98th percentiles of training; None leaves levels to `predict`.
    aspect
        Width over height of the pictures that it was found in: others show another part of what the camera sees, and
        are at fault. None takes pictures of any shape.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}

    x: Share = 0.5
    y: Share = 0.5
    size: Annotated[float, Interval(ge=0.05, le=10)] = 1.0
    roll_deg: Annotated[float, Interval(ge=-180, le=180)] = 0.0
    mirror: bool = False
    low: Level | None = None
    high: Level | None = None
    aspect: Annotated[float, Interval(ge=0.01, le=100)] | None = None
    stretch: Annotated[float, Interval(ge=0.2, le=5)] = 1.0
    cut: Annotated[tuple[Edge, ...], Len(4, 4)] = NO_CUT

    def __post_init__(self) -> None:
        """Refuse levels of which one is lacking, or that are no range."""
        if (self.low is None) != (self.high is None):
            raise ValueError("low and high are given together, or neither")
        if self.low is not None and self.high is not None and self.high - self.low < 1:
            raise ValueError(
                f"low {self.low:g} must lie below high {self.high:g}, by one grey level at least"
            )

    def kept(self, picture: tuple[int, int]) -> tuple[int, int, int, int]:
        """Pixels (left, top, right, bottom) between which a picture (width, height) is left by the cut."""
        left, top, right, bottom = (
            round(share * side) for share, side in zip(self.cut, (*picture, *picture), strict=True)
        )
        return left, top, picture[0] - right, picture[1] - bottom

    def picture_from_view(self, picture: tuple[int, int], view: tuple[int, int]) -> np.ndarray:
        """(2, 3) float64: takes pixels of the view to the picture's; both are (width, height)."""
        left, top, right, bottom = self.kept(picture)
        matrix = self._left_from_view((right - left, bottom - top), view)
        matrix[:, 2] += (left, top)
        return matrix

    def _left_from_view(self, picture: tuple[int, int], view: tuple[int, int]) -> np.ndarray:
        """The same of pictures without what is cut."""
        step = self.size * self.stretch * picture[0] / view[0]
        angle = np.radians(self.roll_deg)
        turn = step * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        turn[:, 0] *= -1 if self.mirror else 1
        turn[0] /= self.stretch
        middle = np.array([self.x * picture[0], self.y * picture[1]]) - 0.5
        return np.column_stack([turn, middle - turn @ ((np.array(view) - 1) / 2)])

    def view(self, picture: np.ndarray, *, width: int, height: int, fades: bool = True) -> np.ndarray:
        """The view (height, width) of a picture (h, w) uint8; a finer picture is averaged, not sampled.

        What is repeated beyond the picture's edges fades out, or stays streaks all through.
        """
        left, top, right, bottom = self.kept((picture.shape[1], picture.shape[0]))
        picture = picture[top:bottom, left:right]
        size = picture.shape[1], picture.shape[0]
        matrix = self._left_from_view(size, (width, height))
        finer = self.size * picture.shape[1] / width
        blurs = [_blur_of(finer), _blur_of(finer * self.stretch)]
        if max(blurs) > 0:
            # each pixel of the view covers so many of the picture's: a Gaussian of half of that lets none alias
            across, down = (max(blur, 1e-3) for blur in blurs)
            picture = cv2.GaussianBlur(picture, (0, 0), across, sigmaY=down)
        seen = cv2.warpAffine(
            picture,
            matrix,
            (width, height),
            flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
            borderMode=cv2.BORDER_REPLICATE,
        )
        shares = _shares(tuple(matrix.ravel()), size, (width, height), self.stretch) if fades else None
        return seen if shares is None else _faded(seen, shares)


def whole_view(picture: tuple[int, int], view: tuple[int, int]) -> CameraPlacement:
    """All of pictures of another shape than the view's; both are (width, height).

    On films of real eyes it costs less than the middle of the picture, or the picture squeezed into the view
    (docs/measurements/headset-networks.md).
    """
    size = max(1.0, picture[1] * view[0] / (picture[0] * view[1]))
    return CameraPlacement(size=size, aspect=picture[0] / picture[1])


def _blur_of(finer: float) -> float:
    """Standard deviation in pixels of a picture that is so many times as fine as its view."""
    return 0.4 * float(np.sqrt(finer**2 - 1)) + 1e-3 if finer > 1 else 0.0


@lru_cache(maxsize=64)
def _shares(
    picture_from_view: tuple[float, ...], picture: tuple[int, int], view: tuple[int, int], stretch: float
) -> np.ndarray | None:
    """How much of each blur every pixel of a view has (blurs, height, width) float32; None where all are 0."""
    matrix = np.array(picture_from_view).reshape(2, 3)
    across, down = np.meshgrid(np.arange(view[0]), np.arange(view[1]))
    at = np.stack([across, down], axis=-1) @ matrix[:, :2].T + matrix[:, 2]
    beyond = np.maximum(np.maximum(-at, at - (np.array(picture) - 1)), 0)
    square = np.array([stretch, 1.0])
    step = np.sqrt(abs(np.linalg.det(square[:, None] * matrix[:, :2])))
    outside = np.hypot(*np.moveaxis(beyond * square, -1, 0)) / step
    shares = np.array([np.clip(outside / (blur * view[0]) - 0.5, 0, 1) for blur in _FADES])
    return shares.astype(np.float32) if shares.any() else None


def _faded(seen: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """A view (height, width) uint8 with shares of its blurs."""
    seen = mixed = seen.astype(np.float32)
    for blur, share in zip(_FADES, shares, strict=True):
        mixed = mixed + share * (_blurred(seen, blur * seen.shape[1]) - mixed)
    return np.rint(mixed).astype(np.uint8)


def _blurred(seen: np.ndarray, sigma: float) -> np.ndarray:
    """A Gaussian blur of a view (height, width) float32; a wide one of a smaller view, in a third of the time."""
    height, width = seen.shape
    shrunk = max(1, int(sigma / 2))
    if shrunk == 1:
        return cv2.GaussianBlur(seen, (0, 0), sigma)
    small = cv2.resize(seen, (round(width / shrunk), round(height / shrunk)), interpolation=cv2.INTER_AREA)
    return cv2.resize(cv2.GaussianBlur(small, (0, 0), sigma / shrunk), (width, height))
