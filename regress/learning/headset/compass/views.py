"""Draws views of eyes in every orientation, as searches for a placement come upon them."""

import cv2
import numpy as np

from regress.errors import InputError
from regress.learning.headset.arrays import HeadsetArrays
from regress.runtime.headset.network.parts import is_of_one_eye, side_of
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.compass import COMPASS_SIDE, QUARTERS

_SIZE, _SHIFT, _ROLL_DEG, _STRETCH = 0.25, 0.08, 14.0, 0.12
"""Standard deviations of a view: of the logarithm of its size, of its place (of the width), in degrees, and of the
logarithm of a stretch along any direction, squeezed as much across it. They add to what drawn headsets differ by."""


def eyes_of(arrays: HeadsetArrays, rows: np.ndarray) -> np.ndarray:
    """Pictures (n, h, w) uint8 of all cameras of one eye, right ones in a mirror: all look like left eyes.

    Raises
    ------
    InputError
        Where no camera of one eye is among them, or these cameras' pictures are of several sizes.
    """
    eyes = [
        arrays.pictures[name][rows][:, :, :: -1 if side_of(name) == "right" else 1]
        for name in arrays.pictures
        if is_of_one_eye(name)
    ]
    if not eyes:
        raise InputError(
            f"{arrays.folder} has no camera of a left or right eye; the compass learns from such pictures"
        )
    if len({one.shape[1:] for one in eyes}) > 1:
        raise InputError(
            f"{arrays.folder} has eyes' cameras of several sizes; give the spec cameras of one, or render.size_px"
        )
    return np.concatenate(eyes)


def draw_views(random: np.random.Generator, pictures: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A view of each picture (n, h, w): (n, 64, 64) uint8, and its orientation (n,) int64, any of eight."""
    orientations = random.integers(0, 2 * QUARTERS, len(pictures))
    views = [
        _draw_view(random, picture, int(one)) for picture, one in zip(pictures, orientations, strict=True)
    ]
    return np.stack(views), orientations


def _draw_view(random: np.random.Generator, picture: np.ndarray, orientation: int) -> np.ndarray:
    quarter, mirrored = divmod(orientation, 2)
    roll_deg = 90 * quarter + _ROLL_DEG * random.standard_normal()
    placement = CameraPlacement(
        x=0.5 + _SHIFT * random.standard_normal(),
        y=0.5 + _SHIFT * random.standard_normal(),
        size=float(np.exp(_SIZE * random.standard_normal())),
        roll_deg=float((roll_deg + 180) % 360 - 180),
        mirror=bool(mirrored),
    )
    return placement.view(_draw_stretched(random, picture), width=COMPASS_SIDE, height=COMPASS_SIDE)


def _draw_stretched(random: np.random.Generator, picture: np.ndarray) -> np.ndarray:
    """A picture drawn out along some direction, as if the camera looked at the face from further to a side."""
    along, factor = random.uniform(0, np.pi), np.exp(_STRETCH * random.standard_normal())
    turn = np.array([[np.cos(along), -np.sin(along)], [np.sin(along), np.cos(along)]])
    stretch = turn @ np.diag([factor, 1 / factor]) @ turn.T
    middle = (np.array(picture.shape[::-1]) - 1) / 2
    return cv2.warpAffine(
        picture,
        np.column_stack([stretch, middle - stretch @ middle]),
        picture.shape[::-1],
        borderMode=cv2.BORDER_REPLICATE,
    )
