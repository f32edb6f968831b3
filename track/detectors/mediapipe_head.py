"""Turns the matrix that MediaPipe finds of a face into the pose of the head."""

import cv2
import numpy as np

from facegen.conventions import LANDMARK_COUNT
from regress.runtime.heads.fit import FACING
from regress.runtime.stages.head import angles_of

EYES_CM = np.array([0.0, 2.95, 2.28])
"""Origin of our head frame in MediaPipe's canonical face.

The corners of its eyes (vertices 33, 133, 362, 263 in the model file's geometry) are midway at (0, 2.625, 3.466); the
mean face has them 3.3 mm below and 11.9 mm before the middle between the eyeballs (`regress.runtime.heads.eyes`).
"""

LEVEL = cv2.Rodrigues(np.array([-np.radians(8.0), 0.0, 0.0]))[0]
"""From our head frame to the canonical face's axes: a head that looks ahead is pitched down there.

Of four faces in films a fit of ours (`regress.runtime.heads.fit`) has pitches that are 6.2 to 9.6 degrees higher; one
is an avatar that is known to look ahead.
"""


def head_of(camera_from_face: np.ndarray) -> np.ndarray:
    """Position and angles (6,) as `Sample.head` has them.

    Parameters
    ----------
    camera_from_face : (4, 4) float
        From the canonical face to the camera, as MediaPipe gives it: centimetres, x to the picture's right, y up, z
        towards the viewer (OpenGL's camera), and maybe a scale.
    """
    turn = camera_from_face[:3, :3]
    rotation = turn / np.cbrt(np.linalg.det(turn))
    position_m = FACING @ (turn @ EYES_CM + camera_from_face[:3, 3]) / 100
    return np.concatenate([position_m, angles_of((FACING @ rotation @ LEVEL)[None])[0]])


NO_POINTS = np.full((LANDMARK_COUNT, 2), np.nan)
NO_IRISES = np.full((2, 2), np.nan)
NO_HEAD = np.full(6, np.nan)
