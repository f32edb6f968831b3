"""Fits a head to a face's points from where a detector has it, with the perspective that a face aside is seen in.

MediaPipe's matrix turns a head that only moves aside: by .6 of the angle by which it is beside the camera's axis, so
that a face 11.5 degrees aside is 7.5 degrees off. What is fitted here from the same points is off by .5, at .16 ms of
CPU (tests/track/test_detectors.py, on a picture whose turns are exact).
"""

import math

import cv2
import numpy as np

from regress.runtime.heads.fit import FACING
from regress.runtime.heads.shape import load_head_shape
from regress.runtime.stages.head import angles_of

VERTICAL_FOV_DEG = 63.0
"""From the top of a picture to its bottom: the camera that MediaPipe's geometry module takes, so matrices agree."""


def fitted_head(points: np.ndarray, start: np.ndarray, *, width: int, height: int) -> np.ndarray:
    """Position and angles (6,) of the mean head that lies best on a face, as `Sample.head` has them.

    Parameters
    ----------
    points : (68, 2) float64
        Pixels of a picture of this size.
    start : (6,) float64
        A head near it, which is given back where none can be fitted.
    """
    shape = load_head_shape()
    focal_px = height / 2 / math.tan(math.radians(VERTICAL_FOV_DEG) / 2)
    camera = np.array([[focal_px, 0, (width - 1) / 2], [0, focal_px, (height - 1) / 2], [0, 0, 1]])
    vector, position = cv2.Rodrigues(rotation_of(start))[0], start[:3, None].copy()
    there, vector, position = cv2.solvePnP(
        shape.points, points[shape.landmarks], camera, None, vector, position, True, cv2.SOLVEPNP_ITERATIVE
    )
    head = np.concatenate([position[:, 0], angles_of(cv2.Rodrigues(vector)[0][None])[0]])
    return head if there and np.isfinite(head).all() and head[2] > 0 else start


def rotation_of(head: np.ndarray) -> np.ndarray:
    """Camera from head (3, 3): the inverse of `regress.runtime.stages.head.angles_of`."""
    yaw, pitch, roll = head[3:]
    turns = ([0.0, yaw, 0.0], [-pitch, 0.0, 0.0], [0.0, 0.0, -roll])
    about_y, about_x, about_z = (cv2.Rodrigues(np.array(turn))[0] for turn in turns)
    return FACING @ about_y @ about_x @ about_z
