"""A dataset of clips on disk."""

import json

import numpy as np

from facegen.sampling import COMPONENT_NAMES
from facegen.store.record import numbers
from facegen.validation.keypoints import check_shard


def test_clips_are_valid_and_dropped_frames_have_no_detected_points(recorded):
    assert not list(check_shard(recorded, 0))
    detected, exact = recorded.array("detected_2d"), recorded.array("points_2d")
    lost = np.isnan(detected).all(axis=(1, 2))
    assert 0 < lost.sum() < len(lost) / 3
    assert np.isfinite(detected[~lost]).all()
    assert np.isfinite(exact).all()
    assert set(json.dumps(numbers(detected[lost][0])).replace("null", "")) <= set(
        "[], "
    )  # NaN is null in JSON


def test_rows_say_where_they_stand(recorded):
    clip, frame, time_s = (recorded.array(name) for name in ("clip", "frame", "time_s"))
    np.testing.assert_array_equal(clip, np.arange(480) // 60)
    np.testing.assert_array_equal(frame, np.arange(480) % 60)
    np.testing.assert_allclose(time_s, frame / 30)
    component = recorded.keypoints()["component"].to_pylist()
    assert component[::60] == ["neutral", "peak", "peak", "sentence"] * 2
    assert set(component) <= set(COMPONENT_NAMES)
    neutral = recorded.array("neutral")
    np.testing.assert_array_equal(neutral, np.array(component) == "neutral")
