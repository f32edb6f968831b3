"""Says what a camera's recorded pictures are before anybody looks for an eye: barred, shrunk in width, of two views."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import cv2
import numpy as np

from regress.runtime.even_rows import even_rows
from regress.runtime.headset.fitness.misfits import Finding, Misfit
from regress.runtime.headset.pictures.bars import LOOKED_AT, bars_of
from regress.runtime.headset.pictures.placement import NO_CUT, CameraPlacement

NARROW = 0.6
"""Width over height, of the view's, below which pictures may be shrunk: two views side by side, each to its half."""

_STRETCH = 2.0

_SQUARE = 0.2
"""By which a picture's width over its height differs from 1 at most where two shrunk views may be in it."""

_TWO_VIEWS, _MARGIN = 0.88, 0.15
"""Correlation of a half with the middle of the other one, less such a share of the half at each side, from which a
picture is two views. Rendered mouths upright have .68 at most, on their side .83, and one real mouth .44; two views of
them that lie up to a tenth of the picture apart have .96 and more."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedShape:
    """A camera's pictures (n, h, w) uint8 as they are judged, and what was done to them.

    Parameters
    ----------
    pictures
        Without bars, and stretched.
    cut, stretch
        As `CameraPlacement` has them.
    """

    pictures: np.ndarray
    cut: tuple[float, ...] = NO_CUT
    stretch: float = 1.0

    def of_recorded(self, placement: CameraPlacement) -> CameraPlacement:
        """A placement in these pictures as one in those that were recorded."""
        return replace(placement, cut=self.cut, stretch=self.stretch)

    def stretched(self) -> "RecordedShape":
        """The same with pixels that are twice as wide as high."""
        height, width = self.pictures.shape[1:]
        size = (round(width * _STRETCH), height)
        return replace(
            self, pictures=np.stack([cv2.resize(one, size) for one in self.pictures]), stretch=_STRETCH
        )

    def may_be_shrunk(self, view: tuple[int, int]) -> bool:
        """Whether they are so narrow beside a view (width, height)."""
        height, width = self.pictures.shape[1:]
        return width * view[1] < NARROW * height * view[0]

    def findings(self, name: str) -> Iterator[Finding]:
        """What was done to them, in sentences."""
        if any(self.cut):
            left, top, right, bottom = (round(100 * share) for share in self.cut)
            yield Finding(
                camera=name,
                misfit=Misfit.BARS,
                sentence=f"{name} has bars at its pictures' edges ({left} % at the left, {top} % at the top, {right} % "
                f"at the right, {bottom} % at the bottom); record without them, or take --placement, which leaves them "
                f"out",
            )
        if self.stretch != 1:
            yield Finding(
                camera=name,
                misfit=Misfit.SHRUNK,
                sentence=f"{name} is shrunk in width, as cameras do that put two views into one picture; take "
                f"--placement, which makes its pixels {self.stretch:g} times as wide as high",
            )


def without_bars(pictures: np.ndarray) -> RecordedShape:
    """Pictures (n, h, w) uint8 of a take, without bars."""
    cut = bars_of(pictures[even_rows(len(pictures), LOOKED_AT)])
    left, top, right, bottom = CameraPlacement(cut=cut).kept((pictures.shape[2], pictures.shape[1]))
    return RecordedShape(pictures=pictures[:, top:bottom, left:right], cut=cut)


def two_views(name: str, pictures: np.ndarray) -> Iterator[Finding]:
    """The finding of a mouth's camera whose pictures (n, h, w) show two views, each shrunk to a half."""
    height, width = pictures.shape[1:]
    if abs(width / height - 1) > _SQUARE:
        return
    chosen = pictures[even_rows(len(pictures), LOOKED_AT)]
    mean, half = chosen.mean(axis=0, dtype=np.float32), width // 2
    margin = max(1, round(_MARGIN * half))
    middle = np.ascontiguousarray(mean[:, margin : half - margin])
    other = np.ascontiguousarray(mean[:, -half:])
    if middle.std() > 0 and cv2.matchTemplate(other, middle, cv2.TM_CCOEFF_NORMED).max() > _TWO_VIEWS:
        yield Finding(
            camera=name,
            misfit=Misfit.VIEWS,
            sentence=f"{name} shows two views side by side: its halves are alike; put #left behind its path and check "
            f"it again",
        )
