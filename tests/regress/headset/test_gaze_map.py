"""From where a pupil lies between the eye's corners to where the eye looks."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.answers.traced_eyes import eye_features
from regress.runtime.headset.eyes.gaze_map import gaze_map
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from tests.regress.headset.test_traced_eyes import EYE, seen_points


@pytest.fixture(scope="module")
def many() -> HeadsetPredictor:
    return load_headset_predictor("headset-any")


@given(st.floats(-20, 20), st.floats(-15, 15), st.floats(1, 8))
def test_of_many_headsets_an_eye_turns_as_far_as_geometry_says(
    many: HeadsetPredictor, yaw: float, pitch: float, pixels_a_mm: float
):
    true = np.array([[0.0, 0.0], [yaw, pitch]])
    pupil, _ = eye_features(seen_points(true, np.full(2, 9.0), pixels_a_mm=pixels_a_mm, turn_deg=0.0), EYE)
    said = np.column_stack([pupil, np.ones(2)]) @ gaze_map(many, "left_eye").T
    # the eyeball seen here is a twentieth smaller than most, and sines are a little below their angles
    np.testing.assert_allclose(said, true, atol=0.1 * np.abs(true).max() + 1e-6)


@pytest.mark.parametrize("model", ["headset-tracking3", "headset-any"])
def test_where_a_pupil_goes_the_gaze_goes(model: str):
    """Right in the picture is the subject's left, of both eyes, and up is up; of one headset the map is its own."""
    predictor = load_headset_predictor(model)
    for camera in ("left_eye", "right_eye"):
        one = gaze_map(predictor, camera)
        assert 50 < one[0, 0] < 70
        assert -70 < one[1, 1] < -50
    own = predictor.model.looks["left_eye"].gaze
    assert (gaze_map(predictor, "left_eye") == np.array(own)).all() == (model == "headset-tracking3")
