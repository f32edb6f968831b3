"""A recording as the Live Link Face app writes it."""

import numpy as np

from facegen.formats import live_link_csv
from regress.runtime.prediction import Prediction


def live_link_text(prediction: Prediction) -> str:
    """The app's 63 columns: weights, and of its nine angles those of the eyes where there is a gaze.

    In the app's recordings an eye's yaw is -0.60 times lookOut less lookIn of the left eye, and pitch -0.56 times
    lookUp less lookDown (4,030 frames of one take, correlations of .996 and more): radians with the opposite signs.

    Raises
    ------
    InputError
        Where no frame has a time.
    """
    rotations, gaze = None, prediction.gaze
    if gaze is not None:
        rotations = np.zeros((len(gaze), 9))
        rotations[:, [3, 4, 6, 7]] = -gaze
    return live_link_csv(prediction.weights, prediction.known_times_s, rotations=rotations)
