"""Both eyes meet in front, and the surer one leads."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.eyes.vergence import READING_DEG, WIDEST_VERGENCE_DEG, meeting

angles = st.floats(-60, 60)
errors = st.floats(0.1, 30)


@given(angles, angles, angles, angles, errors, errors)
def test_lines_of_sight_meet_and_a_second_time_changes_nothing(
    yaw, pitch, other_yaw, other_pitch, off, other_off
):
    gaze = np.array([[[yaw, pitch], [other_yaw, other_pitch]]])
    variance = np.array([off, other_off]) ** 2
    met = meeting(gaze, variance)
    vergence = met[0, 1, 0] - met[0, 0, 0]
    assert -1e-9 <= vergence <= WIDEST_VERGENCE_DEG + 1e-9
    assert abs(met[0, 0, 1] - met[0, 1, 1]) < 1e-9
    np.testing.assert_allclose(meeting(met, variance), met, atol=1e-9)
    moved = np.abs(met - gaze)[0].max(axis=1)
    # of the two, the surer eye gives way by less
    assert (moved[0] - moved[1]) * (off - other_off) >= -1e-9
    if 0 <= other_yaw - yaw <= READING_DEG:
        np.testing.assert_array_equal(met[0, :, 0], gaze[0, :, 0])


def test_eyes_meet_no_nearer_than_ten_centimetres():
    far, near = np.array([[[-30.0, 0.0], [30.0, 0.0]]]), 2 * np.degrees(np.arctan2(0.062 / 2, 0.1))
    met = meeting(far, np.array([1.0, 1.0]))
    np.testing.assert_allclose(met[0, :, 0], [-near / 2, near / 2], atol=0.5)


def test_an_eye_by_itself_stays_as_it_is():
    gaze = np.array([[[5.0, 1.0], [np.nan, np.nan]], [[5.0, 1.0], [-5.0, 3.0]]])
    met = meeting(gaze, np.array([1.0, 1.0]))
    np.testing.assert_array_equal(met[0], gaze[0])
    np.testing.assert_allclose(met[1], [[0.0, 2.0], [0.0, 2.0]])


def test_a_shut_eye_does_not_squint():
    """What is guessed of it leads to no nearer look than to a page."""
    for guess in (-30.0, 12.0, 30.0):
        met = meeting(np.array([[[0.0, 0.0], [guess, 0.0]]]), np.array([1.0, 401.0]))
        assert abs(met[0, 0, 0]) < 0.1
        assert -1e-9 <= met[0, 1, 0] - met[0, 0, 0] <= READING_DEG + 1e-9
