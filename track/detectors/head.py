"""Makes of MediaPipe's head one before a usual camera, turned as a head beside the camera's axis is.

MediaPipe's geometry module takes every camera to see 63 degrees from top to bottom, which is 79 across a 4:3 picture
and 95 across a 16:9 one; webcams see 55 to 75. And it lays a face out before it knows its depth: points are spread
along their rays by the network's own depths, which shears the face by the angle between its ray and the camera's axis.
A shear is half a turn, so the other half is missing: of 11.5 degrees by which a camera is turned, its matrix misses 6
to 7; what is made of it here misses 2 to 3 (tests/track/test_detectors.py, where pictures are turned exactly).
"""

import math

import cv2
import numpy as np

from regress.runtime.heads.camera import typical_camera
from regress.runtime.heads.fit import FACING
from regress.runtime.stages.head import angles_of

_ASSUMED_FOV_DEG = 63.0
"""From the top of a picture to its bottom (MediaPipe's geometry module)."""


def seen_head(head: np.ndarray, *, width: int, height: int) -> np.ndarray:
    """Position and angles (6,) before the typical camera, of a head (6,) as MediaPipe's matrix has it.

    Parameters
    ----------
    width, height
        Of the picture.
    """
    assumed_px = height / 2 / math.tan(math.radians(_ASSUMED_FOV_DEG) / 2)
    farther = typical_camera(width, height).focal_px / assumed_px
    position_m = head[:3] * [1.0, 1.0, farther]
    borne = _turn_aside(head[:3], share=0.5)
    rotation = _turn_aside(position_m) @ borne.T @ rotation_of(head)
    return np.concatenate([position_m, angles_of(rotation[None])[0]])


def rotation_of(head: np.ndarray) -> np.ndarray:
    """Camera from head (3, 3) of a head (6,): the inverse of `regress.runtime.stages.head.angles_of`."""
    yaw, pitch, roll = head[3:]
    turns = ([0.0, yaw, 0.0], [-pitch, 0.0, 0.0], [0.0, 0.0, -roll])
    about_y, about_x, about_z = (cv2.Rodrigues(np.array(turn))[0] for turn in turns)
    return FACING @ about_y @ about_x @ about_z


def _turn_aside(position_m: np.ndarray, *, share: float = 1.0) -> np.ndarray:
    """Rotation (3, 3) that leads from the camera's axis towards a position, or a share of the way."""
    x, y, z = position_m
    beside = math.hypot(x, y)
    if beside == 0:
        return np.eye(3)
    angle = share * math.atan2(beside, z)
    return cv2.Rodrigues(np.array([-y, x, 0.0]) / beside * angle)[0]
