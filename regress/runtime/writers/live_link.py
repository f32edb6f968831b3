"""A recording as the Live Link Face app writes it."""

import numpy as np

from facegen.formats import live_link_csv
from regress.runtime.prediction import Prediction


def live_link_text(prediction: Prediction) -> str:
    """The app's 63 columns: weights, and of its nine angles those of the eyes where there is a gaze, and of the head.

    In the app's recordings an eye's yaw is -0.60 times lookOut less lookIn of the left eye, and pitch -0.56 times
    lookUp less lookDown (4,030 frames of one take, correlations of .996 and more): radians with the opposite signs.
    These are Unreal's signs of turns in ARKit's frame; the head's follow by the same rule, by which roll keeps ours. No
    recording at hand has head angles that would show it.

    Raises
    ------
    InputError
        Where no frame has a time.
    """
    rotations = np.zeros((len(prediction.samples), 9))
    if prediction.head is not None:
        rotations[:, :3] = np.nan_to_num(prediction.head[:, 3:]) * [-1, -1, 1]
    if prediction.gaze is not None:
        rotations[:, [3, 4, 6, 7]] = -np.nan_to_num(prediction.gaze)
    return live_link_csv(prediction.weights, prediction.known_times_s, rotations=rotations)
