"""Makes both eyes meet in front: lines of sight neither part nor cross nearer than eyes can, and lie in one plane.

The surer eye leads: what is wrong of the two is put right by the squares of how far each is off.
"""

import numpy as np

WIDEST_VERGENCE_DEG = 34.0
"""Between both lines of sight: eyes 62 mm apart that look at a spot 10 cm away."""

READING_DEG = 12.0
"""The same of a page 30 cm away: nearer looks are not believed of one eye alone, as of one that is shut."""

_ALONE = 0.9
"""Share of the error from which an eye says nothing of how near a look is."""


def meeting(gaze_deg: np.ndarray, variance: np.ndarray) -> np.ndarray:
    """Gaze (n, 2, 2) whose lines of sight meet.

    Parameters
    ----------
    gaze_deg : (n, 2, 2)
        Left eye first; yaw to the subject's left and pitch upwards. Frames in which an eye is NaN stay as they are.
    variance : (n, 2) or (2,)
        Of each eye's angles, in any unit.

    Returns
    -------
    (n, 2, 2) float64
    """
    gaze = np.array(gaze_deg, dtype=np.float64)
    shares = np.broadcast_to(variance, gaze.shape[:2]) / np.sum(variance, axis=-1, keepdims=True)
    both = np.isfinite(gaze).all(axis=(1, 2))
    left, right = gaze[both, 0], gaze[both, 1]
    off_left, off_right = shares[both].T
    vergence = right[:, 0] - left[:, 0]
    alone = np.clip((np.maximum(off_left, off_right) - 0.5) / (_ALONE - 0.5), 0, 1)
    wrong = vergence - np.clip(vergence, 0, WIDEST_VERGENCE_DEG + alone * (READING_DEG - WIDEST_VERGENCE_DEG))
    yaw = [left[:, 0] + wrong * off_left, right[:, 0] - wrong * off_right]
    # who is off by more counts by less
    pitch = left[:, 1] * off_right + right[:, 1] * off_left
    gaze[both] = np.stack([np.column_stack([one, pitch]) for one in yaw], axis=1)
    return gaze
