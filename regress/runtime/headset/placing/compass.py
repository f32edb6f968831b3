"""Tells how an eye lies in pictures of any camera: upright or turned by quarters, and whether in a mirror.

A small network of its own answers, trained on rendered eyes of drawn headsets in every orientation
(``regress headset compass``). A headset's network only says how sure it is of its points, and is now and then surer of
an eye in a mirror.
"""

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

import numpy as np

from regress.runtime.onnx_session import open_session

if TYPE_CHECKING:
    from regress.runtime.onnx_session import Session

COMPASS_SIDE = 64
"""Pixels of the square views that it sees."""

QUARTERS, ORIENTATIONS = 4, 8
"""Orientation ``2 * quarter + mirrored``: the view is turned by so many quarters (`CameraPlacement.roll_deg`), and
looked at in a mirror or not. 0 is a left eye upright, as training's cameras show it."""

_FILE = "data/eye_compass.onnx"


@dataclass(frozen=True, kw_only=True, eq=False)
class EyeCompass:
    """A session of onnxruntime on the compass's graph: views (n, 64, 64) uint8 in, logarithms of shares (n, 8) out."""

    session: "Session"

    def log_shares(self, views: np.ndarray, *, of_right_eye: bool) -> np.ndarray:
        """(8,) float64: mean logarithm, over a take's views, of the share that each orientation has.

        Parameters
        ----------
        views : (n, h, w) uint8
            What a network would see of an eye's camera.
        of_right_eye
            Whether the camera is the right eye's: the compass knows left eyes, and a right one is one in a mirror.
        """
        import cv2

        size = (COMPASS_SIDE, COMPASS_SIDE)
        seen = np.stack([cv2.resize(view, size, interpolation=cv2.INTER_AREA) for view in views])
        if of_right_eye:
            seen = np.ascontiguousarray(seen[:, :, ::-1])
        (logarithms,) = self.session.run(None, {"views": seen})
        return logarithms.astype(np.float64).mean(axis=0)


@cache
def eye_compass() -> EyeCompass:
    """The one that the package ships."""
    return EyeCompass(session=open_session(files("regress").joinpath(_FILE).read_bytes()))
