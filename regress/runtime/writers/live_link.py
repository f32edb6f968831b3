"""A recording as the Live Link Face app writes it."""

import numpy as np

from facegen.formats import live_link_csv
from regress.runtime.prediction import Prediction

_HEAD_SIGNS = np.array([1, 1, -1])
"""On yaw, pitch and roll of `Sample.head`. Read from receivers of the app: VRCFaceTracking/LiveLinkTrackingModule,
``ArKitPacketReader.cs``, negates all three, and has yaw positive to the right, pitch downwards, roll to the left
(``UnifiedData.cs``). The sender MeFaMo (``mefamo.py``) turned its three round to these."""


def live_link_text(prediction: Prediction) -> str:
    """The app's 63 columns: weights, and of its nine angles those of the eyes where there is a gaze, and of the head.

    Timecodes count from the first frame.

    Raises
    ------
    InputError
        Where no frame has a time.
    """
    time_s = prediction.known_times_s
    return live_link_at(prediction, time_s - time_s[:1])


def live_link_at(prediction: Prediction, time_s: np.ndarray) -> str:
    """The same with timecodes of these times (n,), as of a row of a longer take."""
    rotations = app_angles(len(prediction.samples), prediction.head, prediction.gaze)
    return live_link_csv(prediction.weights, time_s, rotations=rotations)


def app_angles(count: int, head: np.ndarray | None, gaze: np.ndarray | None) -> np.ndarray:
    """Yaw, pitch and roll of head, left and right eye (n, 9) as the app has them; 0 where they are not known.

    In the app's recordings an eye's yaw is -0.60 times lookOut less lookIn of the left eye, and pitch -0.56 times
    lookUp less lookDown (4,030 frames of one take, correlations of .996 and more): radians with the opposite signs.
    The head's signs are not those of the eyes: yaw and pitch as we have them, roll the other way round. No recording at
    hand has head angles that would show it.

    Parameters
    ----------
    count
        Of the n frames.
    head : (n, 6) float64 or None
        As samples have it.
    gaze : (n, 4) float64 or None
        As samples have it.
    """
    angles = np.zeros((count, 9))
    if head is not None:
        angles[:, :3] = np.nan_to_num(head[:, 3:]) * _HEAD_SIGNS
    if gaze is not None:
        angles[:, [3, 4, 6, 7]] = -np.nan_to_num(gaze)
    return angles + 0.0  # of -0 it makes 0
