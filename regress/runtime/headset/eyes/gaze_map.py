"""Gives the map from where a pupil lies between its eye's corners, in irises, to where the eye looks.

A network of one headset has learned it from training's labels, with its cameras' poses in it. Over the cameras of many
headsets such a least-squares map shrinks: what moves a pupil is then mostly where the camera is. That of
`headset-any` has 9 and 23 degrees an iris, of 62 by geometry. So theirs is of the eye alone.
"""

import numpy as np

from regress.runtime.heads.eyes import REACH_M
from regress.runtime.headset.network.predictor import HeadsetPredictor

IRIS_MM = 11.7
"""Diameter of an iris, nearly the same in all people (F. Rüfer et al., "White-to-white corneal diameter", 2005)."""

DEGREES_AN_IRIS = float(np.degrees(IRIS_MM / (1000 * REACH_M)))
"""By which an eye turns while its iris moves by its own diameter, seen from in front: 62."""

_OF_THE_EYE = np.array([[DEGREES_AN_IRIS, 0.0, 0.0], [0.0, -DEGREES_AN_IRIS, 0.0]])


def gaze_map(predictor: HeadsetPredictor, camera: str) -> np.ndarray | None:
    """Yaw and pitch in degrees from x and y in irises and 1, (2, 3); None of a model that has none for this camera.

    That of many headsets says turns alone: what is straight ahead, targets or the direct answer have to say.
    """
    looks = predictor.model.looks.get(camera)
    if predictor.model.of_many_headsets:
        return _OF_THE_EYE
    return None if looks is None or looks.gaze is None else np.array(looks.gaze)
