"""One frame on its way through the stages: what was seen, and what has been made of it so far."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

import numpy as np


@dataclass(frozen=True, kw_only=True, eq=False)
class EyeMeasures:
    """What is measured of both eyes, the subject's left one first; NaN where it is not known.

    Parameters
    ----------
    openness_mm : (2,) float64
        Mean distance of the lids' margins.
    openness : (2,) float64
        As a share of the person's own, from shut (0) to rest (1); wide eyes are above 1.
    pupil : (2,) float64
        Diameter of the pupil over that of the iris.
    """

    openness_mm: np.ndarray
    openness: np.ndarray
    pupil: np.ndarray

    @property
    def mirrored(self) -> "EyeMeasures":
        """Those of the mirrored face."""
        return EyeMeasures(
            openness_mm=self.openness_mm[::-1], openness=self.openness[::-1], pupil=self.pupil[::-1]
        )


NO_EYES = EyeMeasures(openness_mm=np.full(2, np.nan), openness=np.full(2, np.nan), pupil=np.full(2, np.nan))
"""Of a frame without pictures."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Sample:
    """One frame, from a file or as it comes; stages take one and give one, writers take what comes out.

    Parameters
    ----------
    label
        What the frame is called: its number, or a file's name.
    time_s
        Seconds from the start; NaN where this frame's time is not known, None where no frame's is.
    points : (68, 2) float64 or None
        Landmarks in pixels, y down, iBUG order; NaN where there is no face.
    irises : (2, 2) float64 or None
        Centres of the irises in pixels, the subject's left eye first; NaN where they are not seen.
    pictures : mapping of (h, w) uint8, or None
        By headset camera; a camera without a usable picture is left out.
    weights : (k,) float64 or None
        Of the 52 ARKit shapes, or of a retarget's; NaN where nothing could be said.
    gaze : (4,) float64 or None
        Yaw and pitch of the left eye, then of the right eye; radians, yaw to the subject's left, pitch upwards.
    eyes
        What is measured of the eyes; None where no camera sees any.
    head : (6,) float64 or None
        Position of the head's origin in the camera frame in metres, then yaw to the subject's left, pitch upwards and
        roll towards the left shoulder in radians; a head that looks along the camera's axis into it has none of them.
    confidence : (52,) float64 or None
        Trust in each ARKit weight, 0 to 1.
    faults
        What is wrong, by ``"points"`` or the camera's name.
    """

    label: str = ""
    time_s: float | None = None
    points: np.ndarray | None = None
    irises: np.ndarray | None = None
    pictures: Mapping[str, np.ndarray] | None = None
    weights: np.ndarray | None = None
    gaze: np.ndarray | None = None
    eyes: EyeMeasures | None = None
    head: np.ndarray | None = None
    confidence: np.ndarray | None = None
    faults: Mapping[str, Enum] = field(default_factory=dict)
