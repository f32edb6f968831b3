"""Measures how a camera's pictures look (levels, focus, dark rim, flicker), to hold it against training's."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import cv2
import numpy as np
from annotated_types import Interval, Len

from regress.runtime.even_rows import even_rows

SATURATED = 250
"""Grey level from which a pixel counts as saturated."""

DARK, BRIGHT = 2.0, 98.0
"""Percentiles that stand for a picture's levels: glints and dead pixels are beyond them."""

_RIM = 6
"""Grey levels above the darkest that pixels of a lens's rim have in all frames at most."""

MEASURED_FRAMES = 120
"""Frames, evenly chosen, of which a take is measured: twice as many change no figure in its second digit."""

_STRIPS, _OF_BANDS = 12, 0.5
"""Of a picture, and how much their own changes count: where eyes move they change by .042 and .031 in two films of
steady light, and by .13 where bands of 12 % run over them."""

_MOST_FOLLOWED = 300
"""Frames one after another in which light is looked at for flicker."""

Level = Annotated[float, Interval(ge=0, le=255)]
Share = Annotated[float, Interval(ge=0, le=1)]
Sharpness = Annotated[float, Interval(ge=0, le=100)]
Pixel = Annotated[tuple[float, float], Len(2, 2)]


@dataclass(frozen=True, kw_only=True)
class CameraLooks:
    """How a camera's pictures looked in training, each as the 1st, 50th and 99th percentile over people.

    Parameters
    ----------
    low, high
        The 2nd and the 98th percentile of a person's grey levels.
    saturated
        Share of pixels that are saturated.
    sharpness
        `sharpness_of` a person's pictures.
    rim
        `rim_of` a person's pictures.
    points
        Mean pixels of what the camera traces, in the order of ``HeadsetModel.points``.
    gaze
        Of an eye's camera: yaw and pitch in degrees from where the pupil lies between the eye's corners, in irises, and
        from 1 (``regress.runtime.headset.answers.traced_eyes``); None for others, and in older models.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid"}

    low: Annotated[tuple[Level, ...], Len(3, 3)]
    high: Annotated[tuple[Level, ...], Len(3, 3)]
    saturated: Annotated[tuple[Share, ...], Len(3, 3)]
    sharpness: Annotated[tuple[Sharpness, ...], Len(3, 3)]
    rim: Annotated[tuple[Share, ...], Len(3, 3)]
    points: tuple[Pixel, ...] = ()
    gaze: Annotated[tuple[Annotated[tuple[float, ...], Len(3, 3)], ...], Len(2, 2)] | None = None


@dataclass(frozen=True, kw_only=True)
class TakeLooks:
    """How the pictures of one take look; fields as `CameraLooks` has them.

    Parameters
    ----------
    low, high, saturated, sharpness, rim
        Of the take.
    flicker
        `flicker_of` it.
    """

    low: float
    high: float
    saturated: float
    sharpness: float
    rim: float
    flicker: float


def looks_of(pictures: np.ndarray) -> TakeLooks:
    """Measure the pictures (n, h, w) uint8 of a take, in the order of time."""
    chosen = pictures[even_rows(len(pictures), MEASURED_FRAMES)]
    low, high = levels_of(chosen)
    return TakeLooks(
        low=low,
        high=high,
        saturated=float((chosen >= SATURATED).mean()),
        sharpness=sharpness_of(chosen),
        rim=rim_of(chosen),
        flicker=flicker_of(pictures),
    )


def levels_of(pictures: np.ndarray) -> tuple[float, float]:
    """The percentiles `DARK` and `BRIGHT` of pictures (n, h, w) uint8."""
    low, high = np.percentile(pictures, [DARK, BRIGHT])
    return float(low), float(high)


def sharpness_of(pictures: np.ndarray) -> float:
    """How much pictures (n, h, w) uint8 change from pixel to pixel, over how much they change at all; the median.

    Of the pictures' own scale: a soft lens takes the fine changes and leaves the coarse ones. A blur of two pixels
    first, so that a sensor's grain does not pass for detail.
    """
    shares = []
    for picture in pictures:
        calm = cv2.GaussianBlur(picture, (0, 0), 0.7).astype(np.float32)
        fine = calm - cv2.GaussianBlur(calm, (0, 0), 2.0)
        shares.append(float(fine.std()) / max(float(calm.std()), 1e-6))
    return float(np.median(shares))


def rim_of(pictures: np.ndarray) -> float:
    """Share of pixels that are as dark as any in all frames and hang together with a corner: a lens's rim."""
    brightest = pictures.max(axis=0)
    dark = (brightest <= np.percentile(pictures.min(axis=0), 1) + 2 * _RIM).astype(np.uint8)
    count, labels = cv2.connectedComponents(dark, connectivity=4)
    if count < 2:
        return 0.0
    corners = {int(label) for label in labels[[0, 0, -1, -1], [0, -1, 0, -1]]} - {0}
    return float(np.isin(labels, list(corners)).mean()) if corners else 0.0


def flicker_of(pictures: np.ndarray) -> float:
    """By how much of itself a camera's light changes from frame to frame: the median over frames that follow.

    Most of a face does not move from one frame to the next, so the median pixel's change is the light's. Bands of a
    rolling shutter brighten some rows and darken others.
    """
    if len(pictures) < 3:
        return 0.0
    changes, before = [], None
    for picture in pictures[:_MOST_FOLLOWED]:
        light = np.log(np.maximum(picture.astype(np.float32), 8))
        if before is not None:
            strips = [np.median(strip) for strip in np.array_split(light - before, _STRIPS)]
            changes.append(max(abs(np.median(light - before)), _OF_BANDS * np.median(np.abs(strips))))
        before = light
    return float(np.median(changes))
